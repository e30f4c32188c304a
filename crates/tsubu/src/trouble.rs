//! What can go wrong with a command, and the exit code that says so.

use std::fmt;
use std::io::IsTerminal;
use tsubu::model::Damaged;
use tsubu::picture::PictureError;
use tsubu::record::RecordError;
use tsubu::scene::SceneError;

/// A command that ends early.
#[derive(Debug)]
pub enum Trouble {
    /// The scene is wrong.
    Scene(Box<SceneError>),
    /// The arguments are wrong.
    Arguments(String),
    /// The physics failed.
    Physics(String),
    /// The machine refused.
    Machine(String),
    /// Writing failed.
    Record(RecordError),
    /// Drawing failed.
    Picture(PictureError),
}

impl Trouble {
    /// 2 scene or arguments, 3 physics, 4 machine.
    pub fn exit_code(&self) -> u8 {
        match self {
            Trouble::Scene(error) if error.is_by_machine() => 4,
            Trouble::Scene(_) | Trouble::Arguments(_) => 2,
            Trouble::Physics(_) => 3,
            Trouble::Machine(_) => 4,
            Trouble::Record(error) => error.exit_code(),
            Trouble::Picture(_) => 4,
        }
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::Scene(error) => {
                let colour =
                    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
                write!(f, "{}", error.render(colour))
            }
            Trouble::Arguments(text) | Trouble::Physics(text) | Trouble::Machine(text) => {
                write!(f, "error: {text}")
            }
            Trouble::Record(error) => write!(f, "error: {error}"),
            Trouble::Picture(error) => write!(
                f,
                "error: {error}\nhelp: the numbers of the run are written; free some space and run again, or choose another disk with --out"
            ),
        }
    }
}

impl From<SceneError> for Trouble {
    fn from(error: SceneError) -> Self {
        Trouble::Scene(Box::new(error))
    }
}

impl From<Damaged> for Trouble {
    fn from(error: Damaged) -> Self {
        Trouble::Arguments(format!(
            "the checkpoint is whole, but this program cannot go on from it: {error}\n\
             help: go on with the version of tsubu that wrote it, or run the scene again"
        ))
    }
}

impl From<RecordError> for Trouble {
    fn from(error: RecordError) -> Self {
        Trouble::Record(error)
    }
}

impl From<PictureError> for Trouble {
    fn from(error: PictureError) -> Self {
        Trouble::Picture(error)
    }
}
