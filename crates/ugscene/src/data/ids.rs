//! Rows of the tables of a scene.

use std::fmt;
use std::num::NonZeroU32;

#[cfg(doc)]
use crate::{Names, Scene};

macro_rules! index {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of the element at position `idx` of its table.
            ///
            /// # Panics
            /// If `idx` does not fit 32 bits; the reader refuses such scenes.
            pub fn from_index(idx: usize) -> Self {
                Self(u32::try_from(idx).expect("tables have fewer than 2^32 rows"))
            }

            /// Position in its table.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

index! {
    /// Row of [`Scene::vertices`].
    VertexId
    /// Row of [`Scene::bodies`].
    BodyId
}

macro_rules! optional_index {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        ///
        /// `Option` of it has the same size.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(NonZeroU32);

        impl $name {
            /// The id of the element at position `idx` of its table.
            ///
            /// # Panics
            /// If `idx + 1` does not fit 32 bits; the reader refuses such scenes.
            pub fn from_index(idx: usize) -> Self {
                let row = u32::try_from(idx + 1).ok().and_then(NonZeroU32::new);
                Self(row.expect("tables have fewer than 2^32 rows"))
            }

            /// Position in its table.
            pub fn index(self) -> usize {
                self.0.get() as usize - 1
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}({})", stringify!($name), self.index())
            }
        }
    )*};
}
optional_index! {
    /// Row of [`Scene::colors`].
    ColorId
    /// Row of [`Scene::surfaces`].
    SurfaceId
    /// Row of [`Scene::shadings`].
    ShadingId
    /// A name in a [`Names`] table.
    NameId
}
