//! Arrays of fixed length in the API description; the derive loses the length of an array.
//! Use `#[schema(value_type = Numbers2)]` for a field of type `[f64; 2]`.

use std::borrow::Cow;

use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{Array, ArrayBuilder, Schema};
use utoipa::{PartialSchema, ToSchema};

fn list(of: impl Into<RefOr<Schema>>, length: usize) -> Array {
    ArrayBuilder::new().items(of.into()).min_items(Some(length)).max_items(Some(length)).build()
}

macro_rules! lists {
    ($($(#[$about:meta])* $name:ident = $length:literal of $item:expr;)*) => {$(
        $(#[$about])*
        pub struct $name;

        impl PartialSchema for $name {
            fn schema() -> RefOr<Schema> {
                list($item, $length).into()
            }
        }

        impl ToSchema for $name {
            fn name() -> Cow<'static, str> {
                stringify!($name).into()
            }
        }
    )*};
}

lists! {
    /// `[f64; 2]`
    Numbers2 = 2 of f64::schema();
    /// `[f64; 3]`
    Numbers3 = 3 of f64::schema();
    /// `[f64; 4]`
    Numbers4 = 4 of f64::schema();
    /// `[f64; 6]`
    Numbers6 = 6 of f64::schema();
    /// `[[f64; 3]; 3]`
    Rows3 = 3 of list(f64::schema(), 3);
    /// `[u32; 4]`
    Wholes4 = 4 of u32::schema();
    /// `[Vec<f32>; 4]`
    Lists4 = 4 of ArrayBuilder::new().items(f32::schema()).build();
}
