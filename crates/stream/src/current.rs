//! The stream at one moment, and the grains that it pushes.

use crate::{Setting, Unphysical};
use tsubu_model::{Dim, Vector};

/// Grains as slices of equal length.
#[derive(Clone, Copy, Debug)]
pub struct Grains<'a, D: Dim> {
    /// Centres in m.
    pub position: &'a [D::V],
    /// Velocities in m/s.
    pub velocity: &'a [D::V],
    /// Identities, which never change.
    pub identity: &'a [u32],
    /// Diameters in m.
    pub diameter: &'a [f64],
}

impl<D: Dim> Grains<'_, D> {
    /// Refused if a slice has another length than the forces.
    pub(crate) fn demand_as_many_as(&self, forces: usize) -> Result<(), Unphysical> {
        let lengths = [
            ("number of positions", self.position.len()),
            ("number of velocities", self.velocity.len()),
            ("number of identities", self.identity.len()),
            ("number of diameters", self.diameter.len()),
        ];
        match lengths.into_iter().find(|slice| slice.1 != forces) {
            None => Ok(()),
            Some((what, length)) => Err(Unphysical {
                what: what.into(),
                value: length as f64,
                remedy: format!("{forces}, one for each force"),
            }),
        }
    }
}

/// The stream at one moment: what does not depend on the grain is worked out once.
#[derive(Clone, Copy, Debug)]
pub struct Current<'a> {
    pub(crate) setting: &'a Setting,
    pub(crate) level: f64,
    pub(crate) friction_velocity: f64,
    pub(crate) switch: u64,
}

impl Current<'_> {
    /// Velocity of the water in m/s around the grain of this identity: mean flow and fluctuation.
    /// Cost: a logarithm for the mean and, where there is turbulence, a draw; none of it where the water stands.
    #[inline]
    pub fn velocity<D: Dim>(&self, position: D::V, identity: u32) -> D::V {
        let y = position.axis(D::UP) - self.level;
        let shape = self.setting.profile.over_friction_velocity(y);
        let turbulence = &self.setting.turbulence;
        let decay = turbulence.decay(y, shape > 0.0);
        let [along, up, across] = if decay > 0.0 {
            turbulence.fluctuations(identity, self.switch)
        } else {
            [0.0; 3]
        };
        D::V::from_axes(|axis| {
            let over = match axis {
                0 => shape + decay * along,
                _ if axis == D::UP => decay * up,
                _ => decay * across,
            };
            self.friction_velocity * over
        })
    }

    /// Drag in N on a grain: centre in m, velocity in m/s, identity, diameter in m.
    #[inline]
    pub fn force<D: Dim>(
        &self,
        position: D::V,
        velocity: D::V,
        identity: u32,
        diameter: f64,
    ) -> D::V {
        let shelter = self
            .setting
            .shelter
            .factor(position.axis(D::UP) - self.level);
        let relative = self.velocity::<D>(position, identity) - velocity;
        self.setting.water.drag(diameter, shelter, relative)
    }
}
