//! State that is saved and taken back: what a checkpoint is made of.
//!
//! A part of a run that changes what comes after it implements [`Saved`]. It writes numbers into [`Words`] and reads
//! them back in the same order, to the bit. What can be worked out again (lists, tables) is not written. Reading trusts
//! nothing: a count is held against what is left before there is memory for it.

use crate::Vector;
use std::error::Error;
use std::fmt;

/// What a run has to keep so that it goes on to the same bits.
///
/// ```
/// use tsubu_model::{Damaged, Saved, Words};
/// struct Count(u64);
/// impl Saved for Count {
///     fn save(&self, words: &mut Words) {
///         words.put_whole(self.0);
///     }
///     fn restore(&mut self, words: &mut Words) -> Result<(), Damaged> {
///         self.0 = words.take_whole()?;
///         Ok(())
///     }
/// }
/// let (mut words, mut count) = (Words::new(), Count(0));
/// Count(7).save(&mut words);
/// count.restore(&mut words)?;
/// assert_eq!(count.0, 7);
/// # Ok::<(), Damaged>(())
/// ```
pub trait Saved {
    /// Writes the state behind what `words` holds already.
    fn save(&self, words: &mut Words);
    /// Takes it back, into a value made from the same scene.
    ///
    /// # Errors
    /// When the words are not what [`save`](Saved::save) wrote; the value is then of no use.
    fn restore(&mut self, words: &mut Words) -> Result<(), Damaged>;
}

/// Saved words that are not what the program expects.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damaged(pub String);

impl fmt::Display for Damaged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Error for Damaged {}

/// A saved state: words of 64 bits, put one after the other and taken from the front.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    words: Vec<u64>,
    /// The next to be taken.
    next: usize,
}

impl Words {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Those of a file, to be taken.
    pub fn of(words: Vec<u64>) -> Self {
        Self { words, next: 0 }
    }

    /// All of them, taken or not.
    pub fn all(&self) -> &[u64] {
        &self.words
    }

    /// Those that are still to be taken, as a state of their own.
    pub fn rest(mut self) -> Self {
        Self::of(self.words.split_off(self.next))
    }

    /// How many are still to be taken.
    pub fn left(&self) -> usize {
        self.words.len() - self.next
    }

    /// A whole number.
    pub fn put_whole(&mut self, value: u64) {
        self.words.push(value);
    }

    /// A number, to the bit.
    pub fn put_number(&mut self, value: f64) {
        self.put_whole(value.to_bits());
    }

    /// Yes or no.
    pub fn put_flag(&mut self, value: bool) {
        self.put_whole(u64::from(value));
    }

    /// A number that may be absent.
    pub fn put_maybe(&mut self, value: Option<f64>) {
        self.put_flag(value.is_some());
        self.put_number(value.unwrap_or(0.0));
    }

    /// A vector.
    pub fn put_vector<V: Vector>(&mut self, value: V) {
        for axis in 0..V::AXES {
            self.put_number(value.axis(axis));
        }
    }

    /// All words of another state, one after the other.
    pub fn put_all(&mut self, other: &Words) {
        self.words.extend_from_slice(&other.words);
    }

    /// Numbers, with their count.
    pub fn put_numbers(&mut self, values: &[f64]) {
        self.put_whole(values.len() as u64);
        for &value in values {
            self.put_number(value);
        }
    }

    /// A text, with its length in bytes.
    pub fn put_text(&mut self, text: &str) {
        self.put_whole(text.len() as u64);
        for eight in text.as_bytes().chunks(8) {
            let mut bytes = [0; 8];
            bytes[..eight.len()].copy_from_slice(eight);
            self.put_whole(u64::from_le_bytes(bytes));
        }
    }

    /// The name of what follows: a reader that expects something else says so.
    pub fn put_part(&mut self, name: &str) {
        self.put_text(name);
    }

    /// The next whole number.
    pub fn take_whole(&mut self) -> Result<u64, Damaged> {
        let word = self.words.get(self.next).copied();
        self.next += usize::from(word.is_some());
        word.ok_or_else(|| Damaged("the saved state ends too early".into()))
    }

    /// The next number.
    pub fn take_number(&mut self) -> Result<f64, Damaged> {
        Ok(f64::from_bits(self.take_whole()?))
    }

    /// The next yes or no.
    pub fn take_flag(&mut self) -> Result<bool, Damaged> {
        match self.take_whole()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Damaged(format!("{other} stands where 0 or 1 should"))),
        }
    }

    /// The next number that may be absent.
    pub fn take_maybe(&mut self) -> Result<Option<f64>, Damaged> {
        let there = self.take_flag()?;
        let value = self.take_number()?;
        Ok(there.then_some(value))
    }

    /// The next vector.
    pub fn take_vector<V: Vector>(&mut self) -> Result<V, Damaged> {
        let mut axes = [0.0; 3];
        for axis in &mut axes[..V::AXES] {
            *axis = self.take_number()?;
        }
        Ok(V::from_axes(|axis| axes[axis]))
    }

    /// A whole number below `limit`, such as the number of a body; `what` names it in the complaint.
    pub fn take_index(&mut self, limit: usize, what: &str) -> Result<usize, Damaged> {
        match self.take_whole()? {
            word if word < limit as u64 => Ok(word as usize),
            word => Err(Damaged(format!(
                "the number of a {what} is {word}, and there are {limit}"
            ))),
        }
    }

    /// How many items of at least `words_each` words follow: never more than there are words left.
    pub fn take_count(&mut self, words_each: usize) -> Result<usize, Damaged> {
        let count = self.take_whole()?;
        if count > (self.left() / words_each.max(1)) as u64 {
            let left = self.left();
            return Err(Damaged(format!(
                "{count} items of {words_each} words are announced, and {left} words are left"
            )));
        }
        Ok(count as usize)
    }

    /// The next numbers.
    pub fn take_numbers(&mut self) -> Result<Vec<f64>, Damaged> {
        let count = self.take_count(1)?;
        (0..count).map(|_| self.take_number()).collect()
    }

    /// The next text.
    pub fn take_text(&mut self) -> Result<String, Damaged> {
        let length = self.take_whole()?;
        if length.div_ceil(8) > self.left() as u64 {
            return Err(Damaged(format!("a text of {length} bytes is cut short")));
        }
        let mut bytes = Vec::with_capacity(length as usize);
        for _ in 0..length.div_ceil(8) {
            bytes.extend(self.take_whole()?.to_le_bytes());
        }
        bytes.truncate(length as usize);
        String::from_utf8(bytes).map_err(|_| Damaged("a text is not UTF-8".into()))
    }

    /// The name of what follows, which must be this one.
    pub fn take_part(&mut self, name: &str) -> Result<(), Damaged> {
        match self.take_text() {
            Ok(found) if found == name => Ok(()),
            Ok(found) => Err(Damaged(format!(
                "the part `{name}` is expected, and `{found}` is there"
            ))),
            Err(why) => Err(Damaged(format!("the part `{name}` is expected: {why}"))),
        }
    }

    /// A whole number that must be this one, such as a count that the scene fixes.
    pub fn take_same(&mut self, expected: usize, what: &str) -> Result<(), Damaged> {
        match self.take_whole()? {
            word if word == expected as u64 => Ok(()),
            word => Err(Damaged(format!(
                "{word} {what} are saved, and the scene has {expected}"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_put_comes_back_to_the_bit(bits in prop::collection::vec(any::<u64>(), 0..9), text in ".{0,40}", flag in any::<bool>()) {
            let numbers: Vec<f64> = bits.iter().map(|&b| f64::from_bits(b)).collect();
            let mut words = Words::new();
            words.put_part("here");
            words.put_numbers(&numbers);
            words.put_text(&text);
            words.put_flag(flag);
            words.put_maybe(flag.then_some(-0.0));
            words.put_vector(glam::DVec3::new(1.0, -0.0, f64::INFINITY));
            words.take_part("here").unwrap();
            let back: Vec<u64> = words.take_numbers().unwrap().into_iter().map(f64::to_bits).collect();
            prop_assert_eq!(back, bits);
            prop_assert_eq!(words.take_text().unwrap(), text);
            prop_assert_eq!(words.take_flag().unwrap(), flag);
            prop_assert_eq!(words.take_maybe().unwrap().map(f64::to_bits), flag.then_some((-0.0f64).to_bits()));
            let vector: glam::DVec3 = words.take_vector().unwrap();
            prop_assert_eq!(vector.to_array().map(f64::to_bits), [1.0, -0.0, f64::INFINITY].map(f64::to_bits));
            prop_assert_eq!(words.left(), 0);
        }

        /// Whatever stands there, a reader gets an answer and no more memory than there are words.
        #[test]
        fn any_words_are_read_without_a_panic(bits in prop::collection::vec(any::<u64>(), 0..12), huge in any::<bool>()) {
            let mut bits = bits;
            if huge && !bits.is_empty() {
                bits[0] = u64::MAX - 3;
            }
            let all = || Words::of(bits.clone());
            prop_assert!(all().take_numbers().map_or(true, |n| n.len() <= bits.len()));
            prop_assert!(all().take_text().map_or(true, |t| t.len() <= 8 * bits.len()));
            prop_assert!(all().take_part("part").is_err());
            prop_assert!(all().take_count(3).map_or(true, |n| 3 * n <= bits.len()));
            prop_assert!(all().take_index(5, "body").map_or(true, |k| k < 5));
        }
    }
}
