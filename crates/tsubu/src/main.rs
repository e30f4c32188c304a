//! The command `tsubu`.

#[macro_use]
mod say;
mod arguments;
mod check;
mod clock;
mod course;
mod ending;
mod exporting;
mod figures;
mod film;
mod importing;
mod keep;
mod mesh;
mod outputs;
mod progress;
mod resume;
mod rows;
mod run;
mod seeds;
mod shipped;
mod trouble;
mod tune;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match arguments::Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => {
            let code = if message.use_stderr() { 2 } else { 0 };
            // A closed pipe is not worth a panic.
            let _ = message.print();
            return ExitCode::from(code);
        }
    };
    let done = match arguments.command {
        arguments::Command::Run(wish) => run::run(&wish),
        arguments::Command::Resume(wish) => resume::resume(&wish),
        arguments::Command::Check(wish) => check::check(&wish),
        arguments::Command::Tune(wish) => tune::tune(&wish),
        arguments::Command::Mesh(wish) => mesh::mesh(&wish),
        arguments::Command::Export(wish) => exporting::export(&wish),
        arguments::Command::Import(wish) => importing::import(&wish),
        arguments::Command::Scenes => shipped::list(),
        arguments::Command::Init { name } => shipped::init(&name),
    };
    match done {
        Ok(code) => ExitCode::from(code),
        Err(trouble) => {
            tell!("{trouble}");
            ExitCode::from(trouble.exit_code())
        }
    }
}
