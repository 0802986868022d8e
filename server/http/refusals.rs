//! Refusals as the API's description has them. A route names its own; what access and extractors answer is added to
//! every route that has it ([`super::openapi`]).

use std::collections::BTreeMap;

use utoipa::IntoResponses;
use utoipa::openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder};

macro_rules! refusals {
    ($($name:ident = $status:literal $about:literal;)*) => {$(
        #[doc = $about]
        pub struct $name;

        impl IntoResponses for $name {
            fn responses() -> BTreeMap<String, RefOr<Response>> {
                let problem = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem"))).build();
                let response = ResponseBuilder::new().description($about).content("application/problem+json", problem);
                BTreeMap::from([(stringify!($status).to_owned(), response.build().into())])
            }
        }
    )*};
}

refusals! {
    Malformed = 400 "The body or the path cannot be read.";
    Unauthorized = 401 "The token is missing or wrong.";
    ForeignOrigin = 403 "The request comes from another site's page.";
    NotFound = 404 "There is no such thing.";
    TooSlow = 408 "The body did not come in time.";
    Conflict = 409 "It cannot be done with this one.";
    TooLarge = 413 "The body is too large or has too many items.";
    ForeignHost = 421 "The request names a host that the server does not answer for.";
    OutOfRange = 422 "A field has a value that is not allowed.";
    NotUpgraded = 426 "The connection cannot become a WebSocket.";
    TooMany = 429 "There are as many as there may be, or somebody asks too often.";
    Unavailable = 503 "The session is busy or has ended, or the server is stopping.";
}
