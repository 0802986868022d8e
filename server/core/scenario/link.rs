//! A scenario as an experiment link: the part of the page's address after `#`. `web/src/lab/experimentLink.ts` reads it.

use serde_json::Value;

use super::{Parameters, Scenario};
use crate::geometry::Point2;
use crate::map::{Map, is_added};

/// Version of the link format; equal to that of the page.
const VERSION: u32 = 1;

impl Scenario {
    /// The link, including `#`. `None` if the page does not have the map, or if there is a script, which only the page
    /// writes.
    pub fn link(&self) -> Option<String> {
        let is_known = Map::shipped_names().contains(&self.map) || is_added(&self.map);
        if !self.script.is_empty() || !is_known {
            return None;
        }
        let mut link = format!("#v={VERSION}&map={}&controller={}", self.map, self.controller.as_str());
        let mut add = |name: &str, value: String| link.push_str(&format!("&{name}={value}"));
        if let Some(kind) = self.positioner {
            add("positioner", plain(&serde_json::to_value(kind).ok()?));
        }
        add("seed", self.seed.to_string());
        let place = |place: Point2<f64>| format!("{},{}", place.x, place.y);
        if let Some(start) = self.start_m {
            add("start", place(start));
        }
        if let Some(goal) = self.goal_m {
            add("goal", place(goal));
        }
        let (own, defaults) = (fields(&self.parameters)?, fields(&Parameters::default())?);
        for (name, value) in own.iter().filter(|(name, value)| defaults.get(*name) != Some(value)) {
            add(name, plain(value));
        }
        if self.disturbances > 0 {
            add("disturbances", self.disturbances.to_string());
        }
        Some(link)
    }
}

fn fields(parameters: &Parameters) -> Option<serde_json::Map<String, Value>> {
    match serde_json::to_value(parameters).ok()? {
        Value::Object(fields) => Some(fields),
        _ => None,
    }
}

/// A name without quotes; any other value as JSON.
fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{AttractorLaw, ControllerName};

    #[test]
    fn a_link_contains_only_values_other_than_the_default() {
        let idle = Scenario::idle("posts", 7);
        assert_eq!(idle.link().unwrap(), "#v=1&map=posts&controller=attractor&seed=7");
        let parameters =
            Parameters { threshold_m: 0.08, attractor_law: AttractorLaw::Literal, ..Parameters::default() };
        let tuned = Scenario {
            controller: ControllerName::Errt,
            start_m: Some(Point2::new(-0.1234567890123, -0.3)),
            goal_m: Some(Point2::new(0.1, 1e-7)),
            disturbances: 3,
            seed: (1 << 53) - 1,
            parameters,
            ..Scenario::idle("colon", 0)
        };
        // `web/src/lab/experimentLink.test.ts` reads this one.
        assert_eq!(
            tuned.link().unwrap(),
            "#v=1&map=colon&controller=errt&seed=9007199254740991&start=-0.1234567890123,-0.3&goal=0.1,0.0000001\
             &attractor_law=literal&threshold_m=0.08&disturbances=3"
        );
        assert_eq!(Scenario::idle("mine.svg", 7).link(), None);
    }
}
