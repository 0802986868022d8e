//! Error responses for the API's description. A route lists its own; those of access and extractors are added to every
//! route that can return them ([`super::openapi`]).

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
    NotFound = 404 "Not found.";
    TooSlow = 408 "The body did not arrive in time.";
    Conflict = 409 "The resource is in a state that does not allow this.";
    TooLarge = 413 "The body is too large or has too many items.";
    ForeignHost = 421 "The Host header names another server.";
    OutOfRange = 422 "A field has a value that is not allowed.";
    NotUpgraded = 426 "The connection cannot become a WebSocket.";
    TooMany = 429 "Too many exist already, or this client sends too many requests.";
    Unavailable = 503 "The server or the session is busy, or the session has ended.";
}
