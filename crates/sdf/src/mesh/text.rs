//! The doctor's report as a page to read.

use super::doctor::short;
use super::{Report, Verdict};
use std::fmt;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(why) = &self.refused {
            return write!(f, "verdict     refused: {why}");
        }
        let size = self.size();
        writeln!(
            f,
            "mesh        {} triangles, {} vertices{}",
            self.triangles,
            self.vertices,
            if self.parts > 1 {
                format!(", {} parts", self.parts)
            } else {
                String::new()
            }
        )?;
        let side = |x: f64| short(1e3 * x);
        writeln!(
            f,
            "box         {} × {} × {} mm",
            side(size.x),
            side(size.y),
            side(size.z)
        )?;
        writeln!(
            f,
            "surface     area {} m², volume {} m³",
            short(self.area),
            short(self.volume)
        )?;
        self.write_repairs(f)?;
        self.write_shells(f)?;
        self.write_edges(f)?;
        if let (Some(thin), Some(advice)) = (self.thinnest, self.cell_advice()) {
            writeln!(
                f,
                "thinnest    {} mm (2 % of the surface is thinner)",
                side(thin)
            )?;
            writeln!(
                f,
                "grid        cell {} mm = thinnest / 4: distance off by up to {} mm at sharp edges, {} MB",
                side(advice.cell),
                side(advice.error_at_edges),
                short(advice.bytes / 1e6)
            )?;
        }
        if let Some(doubt) = self.unit_doubt() {
            writeln!(f, "unit        {doubt}")?;
        }
        write!(f, "verdict     {}", self.sentence())
    }
}

impl Report {
    /// The verdict as a sentence.
    pub fn sentence(&self) -> String {
        match self.verdict {
            Verdict::Clean => "clean: closed, oriented, no overlap; ready as it is".into(),
            Verdict::Repaired => {
                "repaired: clean once welded and turned, which is done whenever it is used".into()
            }
            Verdict::Winding => {
                let mut text = "usable: inside and outside are told by winding numbers".to_string();
                if self.edges.loops > 0 {
                    text += "; holes are bridged";
                }
                // A pipe without end caps is a rod to winding numbers.
                if self.edges.largest_loop > 0.2 * self.size().length() {
                    text += &format!(
                        "; its largest hole is {} mm wide: if this is a wall and not a solid body, give it a thickness",
                        short(1e3 * self.edges.largest_loop)
                    );
                }
                text
            }
            Verdict::OpenSheet => {
                "an open sheet without an inside: give it a thickness to use it as a wall".into()
            }
            Verdict::Refuse => "refused".into(),
        }
    }

    fn write_repairs(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let done = self.repaired;
        let list: Vec<String> = [
            (done.merged, "vertices merged"),
            (done.degenerate, "faces without area removed"),
            (done.duplicate, "repeated faces removed"),
            (done.turned, "faces turned"),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
        if list.is_empty() {
            writeln!(f, "repaired    nothing to repair")
        } else {
            writeln!(f, "repaired    {}", list.join(", "))
        }
    }

    fn write_shells(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let closed = self.shells.iter().filter(|s| s.closed).count();
        let inward = self.shells.iter().filter(|s| s.inside_out()).count();
        write!(f, "pieces      {}, {closed} closed", self.shells.len())?;
        if inward > 0 {
            write!(f, ", {inward} facing inward (a cavity, or inside out)")?;
        }
        writeln!(f)
    }

    fn write_edges(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let edges = self.edges;
        if edges.is_clean() {
            return writeln!(f, "edges       each joins two faces that agree");
        }
        let mut list = Vec::new();
        if edges.open > 0 {
            list.push(format!(
                "{} open, around {} holes or rims up to {} mm wide",
                edges.open,
                edges.loops,
                short(1e3 * edges.largest_loop)
            ));
        }
        if edges.shared > 0 {
            list.push(format!("{} shared by three faces or more", edges.shared));
        }
        if edges.inconsistent > 0 {
            list.push(format!(
                "{} between faces that disagree",
                edges.inconsistent
            ));
        }
        writeln!(f, "edges       {}", list.join("; "))
    }
}
