//! The seeds as they are typed: a number of them, a list, or from one to another.

/// More is a slip of the pen, as a seed where a number of seeds is meant.
const MOST: u64 = 1000;

/// Seeds in the order in which they run, each once, at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seeds(pub Vec<u64>);

impl Seeds {
    /// Reads `4` (1, 2, 3, 4), `1,2,7` or `3..6` (3, 4, 5, 6).
    pub fn read(text: &str) -> Result<Self, String> {
        let whole = |text: &str| -> Result<u64, String> {
            text.trim().parse().map_err(|_| {
                format!("“{text}” is no seed; write a number of seeds as 4, a list as 1,2,7 or a range as 3..6")
            })
        };
        let range = |from: u64, to: u64| match to.checked_sub(from) {
            None => Err(format!("the range {from}..{to} is empty; write it upwards")),
            Some(more) if more >= MOST => Err(format!(
                "these are more than {MOST} seeds; a single seed is written as a range, {to}..{to}"
            )),
            Some(_) => Ok(Self((from..=to).collect())),
        };
        if let Some((from, to)) = text.split_once("..") {
            return range(whole(from)?, whole(to)?);
        }
        if !text.contains(',') {
            return match whole(text)? {
                0 => Err("no seeds make no run; write how many, as 4".to_owned()),
                count => range(1, count),
            };
        }
        let seeds: Vec<u64> = text.split(',').map(whole).collect::<Result<_, _>>()?;
        let twice = (1..seeds.len()).find(|&i| seeds[..i].contains(&seeds[i]));
        match twice {
            Some(i) => Err(format!(
                "the seed {} is there twice, and would be the same run; write each once",
                seeds[i]
            )),
            None => Ok(Self(seeds)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_a_list_and_a_range_are_read() {
        for (text, seeds) in [
            ("1", vec![1]),
            ("3", vec![1, 2, 3]),
            ("1,2,7", vec![1, 2, 7]),
            ("9, 0", vec![9, 0]),
            ("3..6", vec![3, 4, 5, 6]),
            ("7..7", vec![7]),
        ] {
            assert_eq!(Seeds::read(text), Ok(Seeds(seeds)), "{text}");
        }
        assert_eq!(Seeds::read("1000").map(|s| s.0.len()), Ok(1000));
    }

    #[test]
    fn what_means_no_seeds_is_refused_with_a_remedy() {
        for (text, words) in [
            ("0", "write how many"),
            ("", "as 4"),
            ("four", "as 4"),
            ("-1", "as 4"),
            ("1.5", "as 4"),
            ("1,,2", "as 4"),
            ("1,2,1", "write each once"),
            ("6..3", "upwards"),
            ("..3", "as 4"),
            ("1...3", "as 4"),
            ("1001", "1001..1001"),
            ("0..18446744073709551615", "more than"),
        ] {
            let message = Seeds::read(text).expect_err(text);
            assert!(message.contains(words), "{text}: {message}");
        }
    }
}
