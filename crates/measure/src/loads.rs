//! Force and torque of the grains on every body.

use tsubu_model::{Dim, Observer, Reading, SpinState, View};

/// What each body feels at this moment.
///
/// Rows, for a body named `screw`: `screw.force_x`, `screw.force_y`, `screw.force_z` (N), and for
/// every body that is not at rest for ever `screw.torque_x`, … (N m) about its pivot and
/// `screw.power` (W), the power that its drive gives to the grains, −(F·v + M·ω). A body that has been
/// taken away feels nothing. In the plane the forces along y and the torques about x and z are zero and
/// not listed.
///
/// These are values of one step, and contacts come and go within some ten steps: the mean of many rows
/// is what a bearing feels.
///
/// A grain of 3 N on a floor: `floor.force_z` = −3 N.
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

impl<D: Dim, S: SpinState> Observer<D, S> for Loads {
    fn see(&mut self, view: &dyn View<D, S>) -> Vec<Reading> {
        let flat = <D::V as tsubu_model::Vector>::AXES == 2;
        let mut row = Vec::new();
        for (k, body) in view.bodies().iter().enumerate() {
            let there = if body.removed_at.is_none() { 1.0 } else { 0.0 };
            let mut put = |what: &str, value: f64, unit| {
                row.push(Reading::new(
                    format!("{}.{what}", body.name),
                    value * there,
                    unit,
                ));
            };
            let force = D::to_space(body.force);
            put("force_x", force.x, "N");
            if !flat {
                put("force_y", force.y, "N");
            }
            put("force_z", force.z, "N");
            if !self.movers.get(k).copied().unwrap_or(false) {
                continue;
            }
            if !flat {
                put("torque_x", body.torque.x, "N m");
            }
            put("torque_y", body.torque.y, "N m");
            if !flat {
                put("torque_z", body.torque.z, "N m");
            }
            put("power", body.power(), "W");
        }
        row
    }
}
