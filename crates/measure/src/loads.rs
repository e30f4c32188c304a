//! Force and torque of the grains on every body.

use tsubu_model::{Damaged, Dim, Observer, Reading, Saved, SpinState, View, Words};

/// What each body feels at this moment.
///
/// Rows, for a body named `screw`: `force_x_on_screw`, `force_y_on_screw`, `force_z_on_screw` (N), and for
/// every body that is not at rest for ever `torque_x_on_screw`, … (N m) about its pivot and
/// `power_of_screw` (W), the power that its drive gives to the grains, −(F·v + M·ω). A body that has been
/// taken away feels nothing. In the plane the forces along y and the torques about x and z are zero and
/// not listed. What cannot stand in the name of a column is an underline there.
///
/// These are values of one step, and contacts come and go within some ten steps: the mean of many rows
/// is what a bearing feels.
///
/// A grain of 3 N on a floor: `force_z_on_floor` = −3 N.
#[derive(Clone, Debug, Default)]
pub struct Loads {
    /// Which bodies move at some time, in the order of the scene.
    movers: Vec<bool>,
}

impl Loads {
    /// An observer of bodies of which these move at some time.
    pub fn new(movers: Vec<bool>) -> Self {
        Self { movers }
    }
}

/// It sums nothing up.
impl Saved for Loads {
    fn save(&self, _words: &mut Words) {}

    fn restore(&mut self, _words: &mut Words) -> Result<(), Damaged> {
        Ok(())
    }
}

impl<D: Dim, S: SpinState> Observer<D, S> for Loads {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let flat = <D::V as tsubu_model::Vector>::AXES == 2;
        let mut row = Vec::new();
        let bodies = view.bodies();
        let names = columns(bodies.iter().map(|b| &*b.name));
        for (k, (body, name)) in bodies.iter().zip(names).enumerate() {
            let there = if body.removed_at.is_none() { 1.0 } else { 0.0 };
            let mut put = |what: &str, value: f64, unit| {
                row.push(Reading::new(format!("{what}_{name}"), value * there, unit));
            };
            let force = D::to_space(body.force);
            put("force_x_on", force.x, "N");
            if !flat {
                put("force_y_on", force.y, "N");
            }
            put("force_z_on", force.z, "N");
            if !self.movers.get(k).copied().unwrap_or(false) {
                continue;
            }
            if !flat {
                put("torque_x_on", body.torque.x, "N m");
            }
            put("torque_y_on", body.torque.y, "N m");
            if !flat {
                put("torque_z_on", body.torque.z, "N m");
            }
            put("power_of", body.power(), "W");
        }
        row
    }
}

/// Names fit for columns, each its own.
pub(crate) fn columns<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut fit: Vec<String> = Vec::new();
    for (k, name) in names.enumerate() {
        let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut name: String = name.chars().map(word).collect();
        if fit.contains(&name) {
            name += &format!("_{k}");
        }
        fit.push(name);
    }
    fit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_body_has_a_column_of_its_own_whatever_its_name() {
        let names = ["left wall", "left-wall", "壁", "floor"];
        assert_eq!(
            columns(names.into_iter()),
            ["left_wall", "left_wall_1", "_", "floor"]
        );
    }
}
