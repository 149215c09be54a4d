//! What an answer is in every language: a struct of C's layout, listed once.
//!
//! `answer!` makes of one list of fields the struct, its equality, its form in files and its layout. Rust, C and
//! numpy use the same bytes: `tests/header.rs` writes the struct of the C header from the same list, the wheel makes
//! its record type and its attributes of `LAYOUT`, and C gives it to languages that do not read the header.

use crate::flags::Flags;
use nalgebra::SVector;

/// What a field of an answer can be: a number or an enum of four bytes, a double, or a vector of doubles.
pub(crate) trait Field: Copy {
    /// numpy's name of one number of it.
    const FORMAT: &'static str;
    /// How many numbers it has.
    const COUNT: usize;

    /// Equality; NaN, which does not apply, is equal to itself.
    fn same(&self, other: &Self) -> bool;
    /// Writes its bytes.
    fn put(&self, to: &mut [u8]);

    /// Its doubles; of an enum or a count none.
    fn numbers(&self) -> &[f64] {
        &[]
    }
}

impl Field for f64 {
    const FORMAT: &'static str = "f8";
    const COUNT: usize = 1;

    fn same(&self, other: &Self) -> bool {
        self == other || (self.is_nan() && other.is_nan())
    }

    #[inline(always)]
    fn put(&self, to: &mut [u8]) {
        to[..8].copy_from_slice(&self.to_ne_bytes());
    }

    fn numbers(&self) -> &[f64] {
        std::slice::from_ref(self)
    }
}

impl<const N: usize> Field for SVector<f64, N> {
    const FORMAT: &'static str = f64::FORMAT;
    const COUNT: usize = N;

    fn same(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(a, b)| a.same(b))
    }

    #[inline(always)]
    fn put(&self, to: &mut [u8]) {
        self.iter().zip(to.chunks_exact_mut(8)).for_each(|(number, to)| number.put(to));
    }

    fn numbers(&self) -> &[f64] {
        self.as_slice()
    }
}

/// Of a field its name, numpy's name of a number of it, how many numbers it has, its first byte, and its comment.
pub type Row = (&'static str, &'static str, usize, usize, &'static str);

/// The row of a field.
macro_rules! row {
    ($field:ident: $type:ty, $($doc:literal)*) => {
        (
            stringify!($field),
            <$type as $crate::answer::Field>::FORMAT,
            <$type as $crate::answer::Field>::COUNT,
            std::mem::offset_of!(Self, $field),
            concat!($($doc, "\n"),*).trim_ascii(),
        )
    };
}
pub(crate) use row;

/// A comment with the name that another language has in the place of each link.
pub fn comment_with(comment: &str, name: impl Fn(&str) -> String) -> String {
    let mut pieces = comment.split("[`");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (link, rest) = piece.split_once("`]").unwrap_or((piece, ""));
        text += &name(link);
        // A path in Rust may follow a link.
        text += rest.strip_prefix('(').and_then(|rest| rest.split_once(')')).map_or(rest, |(_, rest)| rest);
    }
    text
}

/// Whether the fields of a struct of this size leave no gaps: then all its bytes are those of its fields.
pub(crate) const fn is_full(layout: &[Row], size: usize) -> bool {
    let (mut sum, mut i) = (0, 0);
    while i < layout.len() {
        // The last letter of "f8", "i4", "u4" is the number of bytes.
        sum += layout[i].2 * (layout[i].1.as_bytes()[1] - b'0') as usize;
        i += 1;
    }
    sum == size
}

/// Fields of four bytes that are equal where their numbers are.
macro_rules! words {
    ($($word:ty, $format:literal, |$value:ident| $number:expr);+ $(;)?) => {
        $(impl $crate::answer::Field for $word {
            const FORMAT: &'static str = $format;
            const COUNT: usize = 1;

            fn same(&self, other: &Self) -> bool {
                self == other
            }

            #[inline(always)]
            fn put(&self, to: &mut [u8]) {
                let $value = *self;
                to[..4].copy_from_slice(&$number.to_ne_bytes());
            }
        })+
    };
}
pub(crate) use words;

words!(u32, "u4", |value| value; Flags, "u4", |flags| flags.bits());

/// The struct of an answer from the list of its fields, each with the value that it has while nothing is known.
///
/// Padding is a field, too: all bytes of an answer are those of its fields.
macro_rules! answer {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $($(#[doc = $doc:literal])* $vis:vis $field:ident: $type:ty = $unknown:expr,)+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[non_exhaustive]
        #[repr(C)]
        pub struct $name {
            $(
                $(#[doc = $doc])*
                #[cfg_attr(feature = "serde", serde(with = "crate::serialisation::field"))]
                $vis $field: $type,
            )+
        }

        impl $name {
            /// An answer of which nothing is known yet.
            pub const UNKNOWN: Self = Self { $($field: $unknown,)+ };

            /// Every field.
            pub const LAYOUT: &'static [$crate::answer::Row] = &[$($crate::answer::row!($field: $type, $($doc)*),)+];

            /// Writes the answer as the C interface and numpy's records have it: `size_of::<Self>()` bytes.
            ///
            /// # Panics
            /// There is less room.
            #[inline(always)]
            pub fn put(&self, to: &mut [u8]) {
                let to = &mut to[..size_of::<Self>()];
                $($crate::answer::Field::put(&self.$field, &mut to[std::mem::offset_of!(Self, $field)..]);)+
            }

            /// The number or the vector of this name; nothing where there is none.
            pub fn numbers(&self, field: &str) -> &[f64] {
                match field {
                    $(stringify!($field) => $crate::answer::Field::numbers(&self.$field),)+
                    _ => &[],
                }
            }
        }

        const _: () = assert!($crate::answer::is_full($name::LAYOUT, size_of::<$name>()));

        /// What does not apply, NaN, counts as equal.
        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                true $(&& $crate::answer::Field::same(&self.$field, &other.$field))+
            }
        }
    };
}
pub(crate) use answer;
