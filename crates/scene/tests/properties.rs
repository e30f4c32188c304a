//! What holds of every text and of every scene.

mod arbitrary;

use arbitrary::scene;
use proptest::prelude::*;
use tsubu_scene::Source;

const SCENE: &str = include_str!("../../../tests/scenes/good/walls_and_comments.ron");
const WET: &str = include_str!("../../../tests/scenes/good/river_bed.ron");

/// A text is checked, or refused with a message that can be drawn.
fn ends_well(source: &Source) {
    match source.check() {
        Ok(checked) => assert!(!checked.scene.to_resolved_ron().is_empty()),
        Err(error) => {
            assert!(!error.headline().is_empty());
            assert!(error.to_string().starts_with("error: "));
            assert!(error.render(true).len() > 20);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_text_ends_well(text in "([(){}\\[\\],:\"'/*#r!a1. \n]|title|grains|.){0,60}", spec in ".{0,30}") {
        let mut source = Source::from_text("x", &text);
        ends_well(&source);
        let _ = source.set(&spec);
        ends_well(&source);
    }

    /// A good scene with a part cut out, and another text put there.
    #[test]
    fn a_damaged_scene_ends_well(wet: bool, from in 0_usize..1800, length in 0_usize..40, with in "([(){}\\[\\],:\"1. \n]|None|inf|-1e400|.){0,4}") {
        let mut signs: Vec<char> = if wet { WET } else { SCENE }.chars().collect();
        let from = from.min(signs.len());
        let to = (from + length).min(signs.len());
        signs.splice(from..to, with.chars());
        ends_well(&Source::from_text("x", &signs.into_iter().collect::<String>()));
    }

    #[test]
    fn any_override_ends_well(
        wet: bool,
        path in "(grains|walls|time|initial|title|still|outlets|measures|water|x)((\\.|\\[)(coarse|floor|0|name|shape|point|motion|turn|within|file|until|grains|law|constants|sizes|bed|datum|profile|\\]){0,3}){0,3}",
        value in "([(){}\\[\\],:\"/'1. \n]|None|\"2 mm\"|Open|.){0,8}",
    ) {
        let mut source = Source::from_text("x", if wet { WET } else { SCENE });
        if source.set(&format!("{path}={value}")).is_ok() {
            ends_well(&source);
        }
    }

    /// The resolved text names every seed there is.
    #[test]
    fn one_seed_reaches_every_random_choice(mut scene in scene(), seed: u64) {
        let any = scene.reseed(seed);
        let text = scene.to_resolved_ron();
        let seeds: Vec<&str> = text.split("seed: ").skip(1).collect();
        prop_assert_eq!(any, !seeds.is_empty());
        for rest in seeds {
            let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
            prop_assert_eq!(digits, seed.to_string());
        }
    }

    #[test]
    fn a_resolved_scene_reads_back(scene in scene()) {
        let text = scene.to_resolved_ron();
        match Source::from_text("resolved", &text).check() {
            Ok(again) => prop_assert_eq!(again.scene, scene),
            Err(error) => prop_assert!(false, "{}\n{}", error, text),
        }
    }
}
