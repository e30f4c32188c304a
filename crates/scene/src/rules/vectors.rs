//! Vectors as the rules need them.

use glam::DVec3;

use super::Rules;
use crate::quantity::{Length, Number, Quantity, Triple};
use crate::scene::Space;

impl Rules<'_> {
    /// Refuses a y other than zero in a plane scene.
    pub(super) fn in_plane(&mut self, path: &str, vector: DVec3) {
        if self.space == Space::Plane && vector.y != 0.0 {
            self.refuse(
                format!("{path}[1]"),
                "a plane scene has no y, but this is not zero",
                "write zero for y, or space: Space",
            );
        }
    }

    /// A direction of length 1; `name` is what it is called in messages.
    pub(super) fn direction(
        &mut self,
        path: &str,
        name: &str,
        example: &str,
        raw: &Triple<Number>,
    ) -> DVec3 {
        unit(numbers(raw)).unwrap_or_else(|| {
            self.refuse(path, format!("the {name} is zero"), example);
            DVec3::Z
        })
    }
}

/// A place, m.
pub(super) fn lengths(raw: &Triple<Quantity<Length>>) -> DVec3 {
    DVec3::from_array(raw.0.map(|length| length.0))
}

pub(super) fn numbers(raw: &Triple<Number>) -> DVec3 {
    DVec3::from_array(raw.0.map(|number| number.0))
}

/// The vector at length 1, untouched if it has it already, so that a resolved scene reads back to the bit.
fn unit(vector: DVec3) -> Option<DVec3> {
    let largest = vector.abs().max_element();
    if largest == 0.0 {
        return None;
    }
    let scaled = vector / largest;
    if (vector.length() - 1.0).abs() <= 4.0 * f64::EPSILON {
        Some(vector)
    } else {
        Some(scaled / scaled.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_vectors() {
        assert_eq!(unit(DVec3::ZERO), None);
        for vector in [
            DVec3::new(1e300, 2e300, 0.0),
            DVec3::new(0.0, 3e-320, 0.0),
            DVec3::new(1.0, 2.0, 3.0),
        ] {
            let once = unit(vector).unwrap_or(DVec3::ZERO);
            assert!((once.length() - 1.0).abs() < 1e-15);
            assert_eq!(unit(once), Some(once));
        }
    }
}
