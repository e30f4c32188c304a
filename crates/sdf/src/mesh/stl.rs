//! STL files, as they are and not as they should be: binary or text, several solids, odd line ends.

use super::{MOST_BYTES, MOST_FACETS, Mesh, MeshError, Part, check_corner, check_unit};
use glam::DVec3;

/// Bytes before the first facet of a binary STL: a free header and the number of facets.
const HEADER: usize = 84;
/// Bytes of a facet of a binary STL.
const FACET: usize = 50;
/// A facet's normal has three words; some programs write more or none. Past this many, give up.
const MOST_WORDS_OF_A_NORMAL: usize = 16;

/// Reads the bytes of an STL file whose numbers are in units of `metres_per_unit` m.
///
/// It is binary if the number of facets at byte 80 fits the length (84 + 50 n bytes or a little more),
/// otherwise text. Text may have any letter case and line ends, several solids, no names and no
/// `endsolid`. Normals in the file are ignored: the order of the corners says the same, and more often right.
///
/// # Errors
/// [`MeshError`] with the line or the facet, both from 1.
pub fn parse_stl(bytes: &[u8], metres_per_unit: f64) -> Result<Mesh, MeshError> {
    check_unit(metres_per_unit)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(MeshError::TooLarge {
            bytes: bytes.len() as u64,
        });
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(MeshError::Empty);
    }
    let announced = bytes
        .get(80..HEADER)
        .map(|n| u64::from(u32::from_le_bytes([n[0], n[1], n[2], n[3]])));
    if let Some(announced) = announced {
        let body = bytes.len() - HEADER;
        let present = (body / FACET) as u64;
        if announced > 0 && announced <= present {
            return binary(&bytes[HEADER..], announced, metres_per_unit);
        }
        if announced == 0 && body.is_multiple_of(FACET) {
            // Some programs write the number last and were stopped: the length knows it.
            return binary(&bytes[HEADER..], present, metres_per_unit);
        }
    }
    text(bytes, metres_per_unit).map_err(|error| match (error, announced) {
        // Text holds no zero byte, so this was a binary file.
        (MeshError::Text { .. }, Some(announced)) if bytes.contains(&0) => MeshError::Truncated {
            announced,
            present: ((bytes.len() - HEADER) / FACET) as u64,
        },
        (error, _) => error,
    })
}

/// A binary STL of the mesh in metres, `name` in its header (at most 79 bytes of it).
///
/// Corners are written as f32, as the format wants: about seven digits. The same mesh gives the same bytes.
pub fn write_stl(mesh: &Mesh, name: &str) -> Vec<u8> {
    let mut out = Vec::with_capacity(HEADER + FACET * mesh.triangles.len());
    // Readers take a file that starts with `solid` for text.
    let name = name.strip_prefix("solid").unwrap_or(name).trim_start();
    out.extend(name.bytes().take(79));
    out.resize(80, 0);
    out.extend((mesh.triangles.len() as u32).to_le_bytes());
    for t in 0..mesh.triangles.len() {
        let corners = mesh.corners(t);
        let normal = super::double_area(corners).normalize_or_zero();
        for v in [normal].iter().chain(&corners) {
            for x in v.to_array() {
                // Adding zero turns −0 into 0, so that equal corners have equal bytes.
                out.extend((x as f32 + 0.0).to_le_bytes());
            }
        }
        out.extend([0, 0]);
    }
    out
}

fn binary(facets: &[u8], count: u64, unit: f64) -> Result<Mesh, MeshError> {
    if count > MOST_FACETS {
        return Err(MeshError::TooManyFacets { facets: count });
    }
    let mut soup = Vec::with_capacity(count as usize);
    for (f, facet) in facets.chunks_exact(FACET).take(count as usize).enumerate() {
        let number = |at: usize| {
            let at = 12 + 4 * at;
            f64::from(f32::from_le_bytes([
                facet[at],
                facet[at + 1],
                facet[at + 2],
                facet[at + 3],
            ])) * unit
        };
        let corner = |c: usize| DVec3::new(number(3 * c), number(3 * c + 1), number(3 * c + 2));
        let corners = [corner(0), corner(1), corner(2)];
        for c in corners {
            check_corner(c, f + 1)?;
        }
        soup.push(corners);
    }
    let part = Part {
        name: String::new(),
        first: 0,
        count: soup.len(),
    };
    Mesh::from_soup(&soup, vec![part])
}

fn text(bytes: &[u8], unit: f64) -> Result<Mesh, MeshError> {
    let mut words = Words {
        bytes,
        at: 0,
        line: 1,
    };
    let mut soup: Vec<[DVec3; 3]> = Vec::new();
    let mut parts: Vec<Part> = Vec::new();
    while let Some(word) = words.next() {
        if is(word, "solid") {
            parts.push(Part {
                name: words.name(),
                first: soup.len(),
                count: 0,
            });
        } else if is(word, "endsolid") {
            words.name();
        } else if is(word, "facet") {
            let corners = facet(&mut words, unit, soup.len() + 1)?;
            if soup.len() as u64 == MOST_FACETS {
                return Err(MeshError::TooManyFacets {
                    facets: MOST_FACETS + 1,
                });
            }
            soup.push(corners);
            if parts.is_empty() {
                parts.push(Part::default());
            }
            if let Some(part) = parts.last_mut() {
                part.count += 1;
            }
        } else {
            return Err(words.wrong(Some(word), "`solid`, `facet` or `endsolid`"));
        }
    }
    Mesh::from_soup(&soup, parts)
}

/// What follows the word `facet`.
fn facet(words: &mut Words, unit: f64, number: usize) -> Result<[DVec3; 3], MeshError> {
    for skipped in 0.. {
        match words.next() {
            Some(word) if is(word, "outer") => break,
            found if found.is_none() || skipped == MOST_WORDS_OF_A_NORMAL => {
                return Err(words.wrong(found, "`outer loop` after a normal"));
            }
            _ => {}
        }
    }
    words.expect("loop", "`loop`")?;
    let mut corners = [DVec3::ZERO; 3];
    for corner in &mut corners {
        words.expect("vertex", "`vertex` (three in each facet)")?;
        let mut numbers = [0.0; 3];
        for x in &mut numbers {
            *x = words.number()? * unit;
        }
        *corner = DVec3::from(numbers);
        check_corner(*corner, number)?;
    }
    words.expect("endloop", "`endloop` (three corners in each facet)")?;
    words.expect("endfacet", "`endfacet`")?;
    Ok(corners)
}

/// True if the word is `wanted` in any letter case.
fn is(word: &[u8], wanted: &str) -> bool {
    word.eq_ignore_ascii_case(wanted.as_bytes())
}

/// The words of a text, with the line they stand in.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// Steps over blanks; stops at a line end if `within_line`.
    fn skip_blanks(&mut self, within_line: bool) {
        while let Some(&b) = self.bytes.get(self.at) {
            let ends_line = b == b'\n' || b == b'\r';
            if !b.is_ascii_whitespace() || (ends_line && within_line) {
                return;
            }
            // A CR before an LF is not yet the end of the line.
            if b == b'\n' || (b == b'\r' && self.bytes.get(self.at + 1) != Some(&b'\n')) {
                self.line += 1;
            }
            self.at += 1;
        }
    }

    fn peek_word(&self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        &rest[..end]
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks(false);
        let word = self.peek_word();
        self.at += word.len();
        (!word.is_empty()).then_some(word)
    }

    /// The rest of the line, or up to the word `facet` where a whole file is one line.
    fn name(&mut self) -> String {
        let mut name: Vec<&[u8]> = Vec::new();
        loop {
            self.skip_blanks(true);
            let word = self.peek_word();
            if word.is_empty() || is(word, "facet") || is(word, "endsolid") {
                return String::from_utf8_lossy(&name.join(&b' ')).into_owned();
            }
            name.push(word);
            self.at += word.len();
        }
    }

    fn expect(&mut self, wanted: &str, expected: &'static str) -> Result<(), MeshError> {
        match self.next() {
            Some(word) if is(word, wanted) => Ok(()),
            found => Err(self.wrong(found, expected)),
        }
    }

    fn number(&mut self) -> Result<f64, MeshError> {
        let word = self.next();
        word.and_then(|w| std::str::from_utf8(w).ok()?.parse().ok())
            .ok_or_else(|| self.wrong(word, "a number"))
    }

    fn wrong(&self, found: Option<&[u8]>, expected: &'static str) -> MeshError {
        let found = match found {
            None => "the end of the file".into(),
            // A binary file taken for text may be one word of megabytes.
            Some(word) => String::from_utf8_lossy(&word[..word.len().min(24)])
                .escape_default()
                .to_string(),
        };
        MeshError::Text {
            line: self.line,
            found,
            expected,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples;
    use proptest::prelude::*;

    const ONE: &str = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid";

    fn facet_text(z: f64) -> String {
        format!(
            "facet normal nan -nan(ind) 1\n outer loop\n vertex 0 0 {z}\n vertex 1e0 0 {z}\n vertex 0 1.0 {z}\n endloop\n endfacet\n"
        )
    }

    #[test]
    fn a_binary_file_comes_back_as_it_was() {
        let ball = samples::ball(0.03, 12);
        let bytes = write_stl(&ball, "solid ball");
        assert_eq!(bytes.len(), 84 + 50 * ball.triangles.len());
        let back = parse_stl(&bytes, 1.0).unwrap();
        assert_eq!(back.triangles.len(), ball.triangles.len());
        assert_eq!(back.vertices.len(), ball.vertices.len());
        for t in 0..ball.triangles.len() {
            for (a, b) in ball.corners(t).iter().zip(back.corners(t)) {
                assert!((*a - b).length() < 1e-8);
            }
        }
    }

    #[test]
    fn text_is_read_in_all_its_dialects() {
        let two = format!(
            "solid first part\n{}endsolid first part\nsolid\n{}{}",
            facet_text(0.0),
            facet_text(1.0),
            facet_text(2.0)
        );
        for text in [
            two.clone(),
            two.replace('\n', "\r\n"),
            two.replace('\n', "\r"),
            two.to_uppercase(),
            format!("  \n{two}"),
        ] {
            let mesh = parse_stl(text.as_bytes(), 0.5).unwrap();
            assert_eq!(mesh.triangles.len(), 3, "{text:?}");
            assert_eq!(mesh.parts.len(), 2);
            assert_eq!((mesh.parts[1].first, mesh.parts[1].count), (1, 2));
            assert_eq!(mesh.bounds()[1], DVec3::new(0.5, 0.5, 1.0));
        }
        let line = parse_stl(ONE.replace('\n', " ").as_bytes(), 1.0).unwrap();
        assert_eq!(line.triangles.len(), 1);
        let latin = [b"solid caf\xe9\n".as_slice(), facet_text(0.0).as_bytes()].concat();
        assert_eq!(parse_stl(&latin, 1.0).unwrap().triangles.len(), 1);
    }

    #[test]
    fn a_header_that_starts_with_solid_is_still_binary() {
        let mut bytes = write_stl(&samples::cuboid(DVec3::ONE, 1), "");
        bytes[..9].copy_from_slice(b"solid\nabc");
        assert_eq!(parse_stl(&bytes, 1.0).unwrap().triangles.len(), 12);
        // A count of zero with facets behind it.
        bytes[80..84].fill(0);
        assert_eq!(parse_stl(&bytes, 1.0).unwrap().triangles.len(), 12);
    }

    #[test]
    fn errors_name_the_place() {
        let wrong = |bytes: &[u8]| parse_stl(bytes, 1.0).unwrap_err().to_string();
        assert!(wrong(b"").contains("no facet"));
        assert!(wrong(b"solid nothing\nendsolid").contains("no facet"));
        assert!(wrong(b"hello world").contains("line 1"));
        let cut = &ONE[..ONE.len() - 30];
        assert!(wrong(cut.as_bytes()).contains("end of the file"));
        let bad = ONE.replace("vertex 1 0 0", "vertex 1 zero 0");
        assert!(wrong(bad.as_bytes()).contains("line 5"));
        assert!(wrong(bad.replace('\n', "\r\n").as_bytes()).contains("line 5"));
        let nan = ONE.replace("vertex 1 0 0", "vertex 1 NaN 0");
        assert!(wrong(nan.as_bytes()).contains("facet 1"));
        let huge = ONE.replace("vertex 1 0 0", "vertex 1 1e300 0");
        assert!(wrong(huge.as_bytes()).contains("unit"));
        let mut bytes = write_stl(&samples::cuboid(DVec3::ONE, 1), "");
        bytes.truncate(400);
        let text = wrong(&bytes);
        assert!(
            text.contains("announces 12") && text.contains("holds 6"),
            "{text}"
        );
        bytes[80..84].fill(255);
        assert!(wrong(&bytes).contains("cut off"));
        assert!(matches!(
            parse_stl(ONE.as_bytes(), 0.0),
            Err(MeshError::Unit { .. })
        ));
    }

    proptest! {
        /// Any answer will do, so long as it is an answer.
        #[test]
        fn random_bytes_give_an_answer(bytes in prop::collection::vec(any::<u8>(), 0..600), solid in any::<bool>()) {
            let bytes = if solid { [b"solid ".as_slice(), &bytes].concat() } else { bytes };
            let _ = parse_stl(&bytes, 1e-3);
        }

        #[test]
        fn a_damaged_file_gives_an_error_or_a_sound_mesh(
            binary in any::<bool>(), cut in 0.0..1.2f64,
            changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        ) {
            let mut bytes = if binary {
                write_stl(&samples::cuboid(DVec3::ONE, 2), "cube")
            } else {
                format!("{ONE}\n{}", facet_text(3.0)).into_bytes()
            };
            bytes.truncate((cut * bytes.len() as f64) as usize);
            for (at, value) in changes {
                if !bytes.is_empty() {
                    let at = at.index(bytes.len());
                    bytes[at] = value;
                }
            }
            if let Ok(mesh) = parse_stl(&bytes, 1.0) {
                let sound = matches!(mesh.check(), Ok(()) | Err(MeshError::NoArea));
                prop_assert!(sound);
                prop_assert!(mesh.triangles.len() <= bytes.len() / 50 + 1);
            }
        }
    }
}
