//! The world: what is in it, as plain data ([`item`], [`spec`], [`map`]), and the shapes that stop
//! robots, sound and light ([`scene`], [`obstacle`]).

pub(crate) mod color;
pub(crate) mod form;
mod gripper;
mod hull;
mod item;
mod map;
pub(crate) mod obstacle;
pub(crate) mod scene;
mod spec;
mod traits;

pub use gripper::Gripper;
pub use hull::Hull;
pub(crate) use item::THINGS;
pub use item::{Item, ItemId, Part, Shape, SpecError};
pub use map::{Cell, Drawing, Drawn};
pub use spec::{WorldSpec, check_bounds};
pub use traits::Traits;
