//! The fenced module: the only unsafe code of the workspace, and the only place that names a vector instruction.
//!
//! The force loop itself is safe, portable code in `pass`. Here it is compiled three times under
//! different target features, and the one thing the compiler does not do well by itself, loading eight
//! lines and transposing them in registers, is written out for AVX2 and AVX-512. All three read the
//! same eight lanes, add in each lane in the same order, divide truly and never fuse, so they give the same bits
//! (`tests` in this file and the whole-scene tests compare them).
#![allow(unsafe_code)]
#![allow(clippy::needless_range_loop)] // rows and columns of a transpose are indexed in step

use crate::kinds::KindSet;
use crate::line::{Layout, Line};
use crate::pass::{Job, Out, chunk_forces};
use crate::world::Tally;
use tsubu_model::{ContactLaw, SpinState};
use tsubu_neighbors::LANES;

/// Which vector instructions the force loop uses. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lanes {
    /// Whatever the build targets; for every machine, and for tools that know no AVX-512.
    Portable,
    /// 256-bit vectors.
    Avx2,
    /// 512-bit vectors.
    Avx512,
}

impl Lanes {
    /// All, narrowest first.
    pub const ALL: [Lanes; 3] = [Lanes::Portable, Lanes::Avx2, Lanes::Avx512];

    /// The widest this machine has.
    pub fn best() -> Self {
        Self::ALL
            .into_iter()
            .rev()
            .find(|l| l.is_here())
            .unwrap_or(Lanes::Portable)
    }

    /// True if this machine has them.
    pub fn is_here(self) -> bool {
        match self {
            Lanes::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Lanes::Avx2 => is_x86_feature_detected!("avx2"),
            #[cfg(target_arch = "x86_64")]
            Lanes::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Lanes::Portable => "portable",
            Lanes::Avx2 => "avx2",
            Lanes::Avx512 => "avx512",
        }
    }
}

/// Eight lines, transposed: `0[c][k]` is number `c` of the line of lane `k`.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Columns(pub [[f64; LANES]; 8]);

/// A way to load eight lines.
pub(crate) trait Gather {
    /// The lines of `block`, whose indices the caller has checked against `lines`.
    fn gather(lines: &[Line], block: &[u32; LANES]) -> Columns;
}

/// The force loop of a chunk on the vector path `lanes`.
/// A path that the machine lacks is never taken: the portable one runs instead.
pub(crate) fn run<D, S, K, L, T>(lanes: Lanes, job: &Job<'_, D, S, K, L, T>, out: Out<'_, D, S>)
where
    D: Layout,
    S: SpinState,
    K: KindSet,
    L: ContactLaw<D, S>,
    T: Tally,
{
    match lanes {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the features were detected on this machine.
        Lanes::Avx512 if lanes.is_here() => unsafe { x86::run_avx512(job, out) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: as above.
        Lanes::Avx2 if lanes.is_here() => unsafe { x86::run_avx2(job, out) },
        _ => chunk_forces::<D, S, K, L, T, Plain>(job, out),
    }
}

/// Asks for the lines of a block that will be gathered soon. It changes nothing but the time.
#[inline(always)]
pub(crate) fn soon(lines: &[Line], block: &[u32; LANES]) {
    #[cfg(target_arch = "x86_64")]
    for k in 0..LANES {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a hint, of every machine of this kind, about memory that is not read.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(lines.as_ptr().wrapping_add(block[k] as usize).cast())
        }
    }
}

struct Plain;

impl Gather for Plain {
    #[inline(always)]
    fn gather(lines: &[Line], block: &[u32; LANES]) -> Columns {
        let mut columns = Columns([[0.0; LANES]; 8]);
        for k in 0..LANES {
            let line = &lines[block[k] as usize].0;
            for c in 0..8 {
                columns.0[c][k] = line[c];
            }
        }
        columns
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::*;
    use std::arch::x86_64::*;

    /// SAFETY: the machine must have AVX-512 F, DQ and VL.
    #[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
    pub(super) unsafe fn run_avx512<D, S, K, L, T>(job: &Job<'_, D, S, K, L, T>, out: Out<'_, D, S>)
    where
        D: Layout,
        S: SpinState,
        K: KindSet,
        L: ContactLaw<D, S>,
        T: Tally,
    {
        chunk_forces::<D, S, K, L, T, Avx512>(job, out)
    }

    /// SAFETY: the machine must have AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn run_avx2<D, S, K, L, T>(job: &Job<'_, D, S, K, L, T>, out: Out<'_, D, S>)
    where
        D: Layout,
        S: SpinState,
        K: KindSet,
        L: ContactLaw<D, S>,
        T: Tally,
    {
        chunk_forces::<D, S, K, L, T, Avx2>(job, out)
    }

    /// The line of lane `k`: indices were checked against the number of lines when the list was built.
    #[inline(always)]
    fn line(lines: &[Line], block: &[u32; LANES], k: usize) -> *const f64 {
        debug_assert!((block[k] as usize) < lines.len());
        // SAFETY: `World` checks after every list build that no index reaches `lines.len()`.
        unsafe { lines.get_unchecked(block[k] as usize).0.as_ptr() }
    }

    struct Avx512;

    impl Gather for Avx512 {
        #[inline(always)]
        fn gather(lines: &[Line], block: &[u32; LANES]) -> Columns {
            // SAFETY: only inlined into `run_avx512`; lines are 64-byte aligned.
            unsafe {
                let r: [__m512d; 8] =
                    std::array::from_fn(|k| _mm512_load_pd(line(lines, block, k)));
                // Pairs of lanes, then pairs of pairs, then halves: the usual 8 × 8 transpose.
                let u: [__m512d; 8] = std::array::from_fn(|i| {
                    let (a, b) = (r[i & !1], r[i | 1]);
                    if i & 1 == 0 {
                        _mm512_unpacklo_pd(a, b)
                    } else {
                        _mm512_unpackhi_pd(a, b)
                    }
                });
                // u[0] = columns 0,2,4,6 of lanes 0,1; u[1] = columns 1,3,5,7 of lanes 0,1; u[2], u[3] of lanes 2,3; …
                let mut out = Columns([[0.0; LANES]; 8]);
                for odd in 0..2 {
                    let (a, b, c, d) = (u[odd], u[2 + odd], u[4 + odd], u[6 + odd]);
                    // 128-bit parts 0..4 of each hold columns odd, odd+2, odd+4, odd+6.
                    let ab_low = _mm512_shuffle_f64x2::<0b_10_00_10_00>(a, b); // a0 a2 b0 b2
                    let ab_high = _mm512_shuffle_f64x2::<0b_11_01_11_01>(a, b); // a1 a3 b1 b3
                    let cd_low = _mm512_shuffle_f64x2::<0b_10_00_10_00>(c, d);
                    let cd_high = _mm512_shuffle_f64x2::<0b_11_01_11_01>(c, d);
                    let store = |out: &mut Columns, column: usize, v: __m512d| {
                        _mm512_store_pd(out.0[column].as_mut_ptr(), v)
                    };
                    store(
                        &mut out,
                        odd,
                        _mm512_shuffle_f64x2::<0b_10_00_10_00>(ab_low, cd_low),
                    ); // a0 b0 c0 d0
                    store(
                        &mut out,
                        odd + 4,
                        _mm512_shuffle_f64x2::<0b_11_01_11_01>(ab_low, cd_low),
                    ); // a2 b2 c2 d2
                    store(
                        &mut out,
                        odd + 2,
                        _mm512_shuffle_f64x2::<0b_10_00_10_00>(ab_high, cd_high),
                    );
                    store(
                        &mut out,
                        odd + 6,
                        _mm512_shuffle_f64x2::<0b_11_01_11_01>(ab_high, cd_high),
                    );
                }
                out
            }
        }
    }

    struct Avx2;

    impl Gather for Avx2 {
        #[inline(always)]
        fn gather(lines: &[Line], block: &[u32; LANES]) -> Columns {
            // SAFETY: only inlined into `run_avx2`; lines are 64-byte aligned.
            unsafe {
                let mut out = Columns([[0.0; LANES]; 8]);
                for half in 0..2 {
                    for lanes in 0..2 {
                        let r: [__m256d; 4] = std::array::from_fn(|k| {
                            _mm256_load_pd(line(lines, block, 4 * lanes + k).add(4 * half))
                        });
                        let (ab_low, ab_high) = (
                            _mm256_unpacklo_pd(r[0], r[1]),
                            _mm256_unpackhi_pd(r[0], r[1]),
                        );
                        let (cd_low, cd_high) = (
                            _mm256_unpacklo_pd(r[2], r[3]),
                            _mm256_unpackhi_pd(r[2], r[3]),
                        );
                        let mut store = |column: usize, v: __m256d| {
                            _mm256_store_pd(out.0[4 * half + column].as_mut_ptr().add(4 * lanes), v)
                        };
                        store(0, _mm256_permute2f128_pd::<0x20>(ab_low, cd_low));
                        store(1, _mm256_permute2f128_pd::<0x20>(ab_high, cd_high));
                        store(2, _mm256_permute2f128_pd::<0x31>(ab_low, cd_low));
                        store(3, _mm256_permute2f128_pd::<0x31>(ab_high, cd_high));
                    }
                }
                out
            }
        }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
        unsafe fn by_avx512(lines: &[Line], block: &[u32; LANES]) -> Columns {
            Avx512::gather(lines, block)
        }

        #[target_feature(enable = "avx2")]
        unsafe fn by_avx2(lines: &[Line], block: &[u32; LANES]) -> Columns {
            Avx2::gather(lines, block)
        }

        #[test]
        fn every_path_transposes_alike() {
            let lines: Vec<Line> = (0..20)
                .map(|i| Line(std::array::from_fn(|c| f64::from(100 * i + c as u32))))
                .collect();
            let block = [3, 19, 0, 7, 7, 12, 1, 18];
            let expected = Plain::gather(&lines, &block).0;
            assert_eq!(expected[5][1], 1905.0);
            if Lanes::Avx2.is_here() {
                // SAFETY: just detected.
                assert_eq!(unsafe { by_avx2(&lines, &block) }.0, expected);
            }
            if Lanes::Avx512.is_here() {
                // SAFETY: just detected.
                assert_eq!(unsafe { by_avx512(&lines, &block) }.0, expected);
            }
        }
    }
}
