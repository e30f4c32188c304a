//! Words for the person at the terminal. A closed pipe (`tsubu check … | head`) is no reason to panic.

/// A line on standard output; nobody listening is not an error.
macro_rules! say {
    ($($word:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stdout(), $($word)*);
    }};
}

/// A line on standard error; nobody listening is not an error.
macro_rules! tell {
    ($($word:tt)*) => {{
        use std::io::Write;
        let _ = writeln!(std::io::stderr(), $($word)*);
    }};
}
