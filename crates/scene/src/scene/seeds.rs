//! The random choices of a scene, and one seed for all of them.

use super::{Fate, Initial, Scene, Turbulence};

impl Scene {
    /// Gives this seed to every random choice: the places of a fill, the heights and vacancies of a bed, the turbulence,
    /// what inlets add and outlets put back. False if the scene has none, so that every seed is the same run.
    pub fn reseed(&mut self, seed: u64) -> bool {
        let mut seeds: Vec<&mut u64> = Vec::new();
        match &mut self.initial {
            Initial::Fill(fill) => seeds.push(&mut fill.seed),
            Initial::Bed(bed) => seeds.push(&mut bed.seed),
            Initial::File(_) | Initial::Grains(_) => {}
        }
        for outlet in &mut self.outlets {
            match &mut outlet.then {
                Fate::Recycle { seed, .. } => seeds.push(seed),
                Fate::Delete => {}
            }
        }
        seeds.extend(self.inlets.iter_mut().map(|inlet| &mut inlet.seed));
        match self.water.as_mut().map(|water| &mut water.turbulence) {
            Some(Turbulence::Switched { seed, .. }) => seeds.push(seed),
            Some(Turbulence::Off) | None => {}
        }
        let any = !seeds.is_empty();
        seeds.into_iter().for_each(|own| *own = seed);
        any
    }
}
