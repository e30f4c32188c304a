//! What LAMMPS and LIGGGHTS print: the time of the loop, and the table of the run.

/// What an engine printed.
#[derive(Clone, Debug)]
pub struct Log {
    /// All of it.
    pub text: String,
}

impl Log {
    /// Seconds of the last stretch of steps, without set-up.
    pub fn loop_time(&self) -> Option<f64> {
        let line = self
            .text
            .lines()
            .rfind(|l| l.starts_with("Loop time of "))?;
        line.split_whitespace().nth(3)?.parse().ok()
    }

    /// A column of the last table, by its name in the head.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let mut at = None;
        let mut values = Vec::new();
        for line in self.text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            if words.first() == Some(&"Step") {
                at = words.iter().position(|w| *w == name);
                values.clear();
                continue;
            }
            let numbers: Option<Vec<f64>> = words.iter().map(|w| w.parse().ok()).collect();
            if let (Some(at), Some(numbers)) = (at, numbers)
                && let Some(value) = numbers.get(at)
            {
                values.push(*value);
            }
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_table_and_the_last_loop_count() {
        let log = Log {
            text: "   Step   c_ke \n 0 1.5\n 10 2.5\nLoop time of 9.0 on 1 procs for 10 steps with 5 atoms\n\
                   Step  Atoms c_ke f_w[1]\n 10 5 2.5 -1\nWARNING: x\n 20 5 3.5 -2e-1\n\
                   Loop time of 0.25 on 2 procs for 10 steps with 5 atoms, finish time x\n"
                .into(),
        };
        assert_eq!(log.loop_time(), Some(0.25));
        assert_eq!(log.column("f_w[1]"), [-1.0, -0.2]);
        assert_eq!(log.column("absent"), [0.0; 0]);
    }
}
