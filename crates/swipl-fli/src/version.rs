//! The numbers that changed between versions.
//!
//! Two changes touch what `swipl` passes or gets (two others are asked about below):
//!
//! * **7.3.23** brought `PL_Q_EXT_STATUS`. Before, a query that ended with an
//!   exception answered 0, like one that failed.
//! * **8.1.22** put rational numbers between integers and floats. All later
//!   types of terms moved up by one, and the flags of text functions got new
//!   bits.
//!
//! This crate and `swipl` use the numbers of [`crate::types`], those since 8.1.22. The running
//! version is asked here, once, and the numbers are translated here and nowhere else. The tables
//! hold what the headers of V7.2.3, V7.6.4 and V8.0.3 say, which agree, beside those of V8.2.4 to
//! V10.1.12, which agree, too.
use crate::types::{
    PL_BLOB, PL_FLOAT, PL_LIST_PAIR, PL_NIL, PL_Q_EXT_STATUS, PL_STRING, PL_TERM, REP_UTF8,
};
use std::ffi::c_int;
use std::sync::atomic::{AtomicU32, Ordering};

/// The first version with rational numbers as a type of their own.
const RATIONAL_TYPES: Version = Version(8_01_22);
/// The first version whose queries distinguish an exception from failure.
const EXTENDED_STATUS: Version = Version(7_03_23);

/// The first version whose hook for input gets a stream, not a descriptor.
const DISPATCHED_STREAMS: Version = Version(9_03_25);

/// The first version that does not prune a nondeterministic predicate that has thrown.
const PRUNED_ONCE: Version = Version(8_01_30);

/// A version of SWI-Prolog: `major * 10000 + minor * 100 + patch`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) struct Version(u32);

/// A number that changed with 8.1.22.
struct Moved {
    since: u32,
    before: u32,
}

const TYPES: [Moved; 6] = [
    Moved { since: PL_FLOAT, before: 4 },
    Moved { since: PL_STRING, before: 5 },
    Moved { since: PL_TERM, before: 6 },
    Moved { since: PL_NIL, before: 7 },
    Moved { since: PL_BLOB, before: 8 },
    Moved { since: PL_LIST_PAIR, before: 9 },
];

const TEXT_FLAGS: [Moved; 1] = [Moved { since: REP_UTF8, before: 0x1000 }];

/// Bits of a text function's flags that hold a type: those of
/// `PL_unify_chars` and `PL_put_chars`. The flags proper lie above them.
const TYPE_BITS: u32 = 0xff;

impl Version {
    /// The version that runs this code.
    #[inline]
    pub(crate) fn running() -> Self {
        static RUNNING: AtomicU32 = AtomicU32::new(0);
        match RUNNING.load(Ordering::Relaxed) {
            0 => {
                let version = ask();
                RUNNING.store(version, Ordering::Relaxed);
                Self(version)
            }
            version => Self(version),
        }
    }

    /// Whether a nondeterministic predicate that throws is called to give up its context.
    #[inline]
    pub(crate) fn prunes_twice(self) -> bool {
        self < PRUNED_ONCE
    }

    /// Whether the hook for input gets a stream, not a descriptor.
    #[inline]
    pub(crate) fn dispatches_streams(self) -> bool {
        self >= DISPATCHED_STREAMS
    }

    fn translates(self) -> bool {
        self < RATIONAL_TYPES
    }

    /// The result of `PL_term_type`, in the numbers of [`crate::types`].
    #[inline]
    pub(crate) fn type_from(self, answered: c_int) -> c_int {
        if self.translates() { type_since(answered) } else { answered }
    }

    /// The flags of `PL_get_nchars`, as this version takes them.
    #[inline]
    pub(crate) fn text_flags(self, flags: u32) -> u32 {
        if self.translates() { text_flags_before(flags) } else { flags }
    }

    /// A type and flags for `PL_unify_chars` or `PL_put_chars`, as this version takes them.
    #[inline]
    pub(crate) fn typed_text_flags(self, flags: c_int) -> c_int {
        if self.translates() {
            let flags = bits(flags);
            let kind = replaced(&TYPES, flags & TYPE_BITS, |moved| (moved.since, moved.before));
            signed(text_flags_before(flags & !TYPE_BITS) | kind)
        } else {
            flags
        }
    }

    /// A type, as this version takes it.
    pub(crate) fn kind(self, kind: u32) -> u32 {
        let before = |kind| replaced(&TYPES, kind, |moved| (moved.since, moved.before));
        if self.translates() { before(kind) } else { kind }
    }

    /// The flags of `PL_open_query`, as this version takes them.
    #[inline]
    pub(crate) fn query_flags(self, flags: c_int) -> c_int {
        if self.has_extended_status() { flags } else { flags & !signed(PL_Q_EXT_STATUS) }
    }

    /// Whether `PL_next_solution` answers -1 for an exception if asked to.
    #[inline]
    pub(crate) fn has_extended_status(self) -> bool {
        self >= EXTENDED_STATUS
    }
}

#[cold]
fn ask() -> u32 {
    const PL_QUERY_VERSION: c_int = 10;
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_query(query: c_int) -> isize;
    }
    // Safety: answers a number in every version.
    let version = unsafe { PL_query(PL_QUERY_VERSION) };
    u32::try_from(version).unwrap_or(u32::MAX)
}

#[cold]
fn type_since(answered: c_int) -> c_int {
    signed(replaced(&TYPES, bits(answered), |moved| (moved.before, moved.since)))
}

#[cold]
fn text_flags_before(flags: u32) -> u32 {
    TEXT_FLAGS.iter().fold(flags, |flags, moved| {
        if flags & moved.since == 0 { flags } else { flags & !moved.since | moved.before }
    })
}

fn replaced(table: &[Moved], number: u32, from_to: impl Fn(&Moved) -> (u32, u32)) -> u32 {
    table
        .iter()
        .map(from_to)
        .find_map(|(from, to)| (from == number).then_some(to))
        .unwrap_or(number)
}

/// C has some of these numbers as `int`, some as `unsigned int`.
pub(crate) fn bits(number: c_int) -> u32 {
    u32::from_ne_bytes(number.to_ne_bytes())
}

fn signed(bits: u32) -> c_int {
    c_int::from_ne_bytes(bits.to_ne_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::types::*;

    const BEFORE: [Version; 4] =
        [Version(7_02_03), Version(7_06_04), Version(8_00_03), Version(8_01_21)];
    const SINCE: [Version; 5] =
        [Version(8_01_22), Version(8_02_04), Version(9_00_04), Version(9_02_09), Version(10_01_12)];

    /// Every constant of `types.rs` but the bits of streams and blobs, as the headers have it:
    /// ours, before 8.1.22 (none if there was no such thing), since.
    const TYPES_IN_HEADERS: [(u32, Option<u32>, u32); 11] = [
        (PL_VARIABLE, Some(1), 1),
        (PL_ATOM, Some(2), 2),
        (PL_INTEGER, Some(3), 3),
        (PL_RATIONAL, None, 4),
        (PL_FLOAT, Some(4), 5),
        (PL_STRING, Some(5), 6),
        (PL_TERM, Some(6), 7),
        (PL_NIL, Some(7), 8),
        (PL_BLOB, Some(8), 9),
        (PL_LIST_PAIR, Some(9), 10),
        (PL_DICT, Some(44), 44),
    ];
    const TEXT_FLAGS_IN_HEADERS: [(u32, u32, u32); 4] = [
        (CVT_ATOM, 0x01, 0x01),
        (CVT_STRING, 0x02, 0x02),
        (BUF_DISCARDABLE, 0, 0),
        (REP_UTF8, 0x1000, 0x0010_0000),
    ];
    /// The same in all versions.
    const UNCHANGED: [(u32, u32); 14] = [
        (PL_FA_NONDETERMINISTIC, 0x04),
        (PL_FA_VARARGS, 0x08),
        (PL_Q_NORMAL, 0x02),
        (PL_Q_CATCH_EXCEPTION, 0x08),
        (PL_ENGINE_SET, 0),
        (PL_ENGINE_INVAL, 2),
        (PL_ENGINE_INUSE, 3),
        (PL_BLOB_MAGIC, 0x7529_3a00 | 1),
        (PL_BLOB_UNIQUE, 0x01),
        (PL_BLOB_TEXT, 0x02),
        (PL_BLOB_NOCOPY, 0x04),
        (SIO_INPUT, 1 << 6),
        (SIO_OUTPUT, 1 << 7),
        (IOENC_ENC_UTF8, 5),
    ];

    #[test]
    fn term_types_are_answered_in_the_numbers_of_today() {
        for (ours, before, since) in TYPES_IN_HEADERS {
            for version in BEFORE {
                if let Some(before) = before {
                    assert_eq!(version.type_from(signed(before)), signed(ours));
                }
            }
            for version in SINCE {
                assert_eq!(version.type_from(signed(since)), signed(ours));
            }
        }
    }

    #[test]
    fn flags_of_text_are_passed_in_the_numbers_of_the_version() {
        for (ours, before, since) in TEXT_FLAGS_IN_HEADERS {
            for version in BEFORE {
                assert_eq!(version.text_flags(ours), before);
            }
            for version in SINCE {
                assert_eq!(version.text_flags(ours), since);
            }
        }
        let asked = CVT_ATOM | CVT_STRING | BUF_DISCARDABLE | REP_UTF8;
        assert_eq!(BEFORE[0].text_flags(asked), 0x1003);
        assert_eq!(SINCE[0].text_flags(asked), 0x0010_0003);
    }

    #[test]
    fn text_of_a_type_is_passed_in_the_numbers_of_the_version() {
        for (ours, before, since) in TYPES_IN_HEADERS {
            for version in BEFORE {
                if let Some(before) = before {
                    let passed = version.typed_text_flags(signed(ours | REP_UTF8));
                    assert_eq!(bits(passed), before | 0x1000);
                }
            }
            for version in SINCE {
                let passed = version.typed_text_flags(signed(ours | REP_UTF8));
                assert_eq!(bits(passed), since | 0x0010_0000);
            }
        }
    }

    #[test]
    fn a_query_asks_for_its_status_only_where_there_is_one() {
        let asked = signed(PL_Q_NORMAL | PL_Q_CATCH_EXCEPTION | PL_Q_EXT_STATUS);
        for (version, passed) in
            [(7_02_03, 0x0a), (7_03_22, 0x0a), (7_03_23, 0x4a), (10_01_12, 0x4a)]
        {
            assert_eq!(Version(version).query_flags(asked), passed);
            assert_eq!(Version(version).has_extended_status(), passed == 0x4a);
        }
    }

    #[test]
    fn what_never_changed_is_what_the_headers_say() {
        for (ours, theirs) in UNCHANGED {
            assert_eq!(ours, theirs);
        }
    }
}
