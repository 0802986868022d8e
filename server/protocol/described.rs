//! Types of lower modules whose file format is also their wire format, described for the page and the API. Each has a
//! mirror here, and serde's `remote` makes the compiler compare the fields.

#![allow(dead_code, reason = "a mirror is only described, never made")]

macro_rules! describe_schema {
    ($($original:path as $mirror:ty;)*) => {$(
        impl utoipa::PartialSchema for $original {
            fn schema() -> utoipa::openapi::RefOr<utoipa::openapi::schema::Schema> {
                <$mirror as utoipa::PartialSchema>::schema()
            }
        }

        impl utoipa::ToSchema for $original {
            fn name() -> std::borrow::Cow<'static, str> {
                <$mirror as utoipa::ToSchema>::name()
            }

            fn schemas(
                schemas: &mut Vec<(String, utoipa::openapi::RefOr<utoipa::openapi::schema::Schema>)>,
            ) {
                <$mirror as utoipa::ToSchema>::schemas(schemas);
            }
        }
    )*};
}

macro_rules! describe {
    ($($original:path as $mirror:ty;)*) => {
        describe_schema! { $($original as $mirror;)* }
        $(
        impl ts_rs::TS for $original {
            type WithoutGenerics = Self;
            type OptionInnerType = Self;

            fn docs() -> Option<String> {
                <$mirror as ts_rs::TS>::docs()
            }

            fn name(config: &ts_rs::Config) -> String {
                <$mirror as ts_rs::TS>::name(config)
            }

            fn decl(config: &ts_rs::Config) -> String {
                <$mirror as ts_rs::TS>::decl(config)
            }

            fn inline(config: &ts_rs::Config) -> String {
                <$mirror as ts_rs::TS>::inline(config)
            }
        }
    )*};
}

mod case;
mod recovery;
mod report;
mod scenario;
