//! Sibling files do not import each other in circles, also not through names that their parent re-exports.

use std::collections::{BTreeMap, BTreeSet};

use super::house::{SourceFile, sources};

type Module = Vec<String>;

/// The source of each module by its path from its crate on, without comments and tests.
fn modules() -> BTreeMap<Module, String> {
    let mut modules = BTreeMap::new();
    for SourceFile { krate, inside, text, .. } in sources() {
        if inside.contains("test") || inside == "main" {
            continue;
        }
        let parts = [krate].into_iter().chain(inside.split('/').filter(|_| inside != "lib"));
        let name = parts.map(str::to_owned).collect();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let code: Vec<&str> = code.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
        modules.insert(name, code.join("\n"));
    }
    modules
}

/// The paths of one `use` declaration: `a::{b, c::d}` are two.
fn expand(tree: &str) -> Vec<String> {
    let Some((prefix, rest)) = tree.split_once('{') else {
        return vec![tree.split(" as ").next().unwrap().trim().to_owned()];
    };
    let inner = rest.rsplit_once('}').unwrap().0;
    let (mut depth, mut start, mut paths) = (0, 0, Vec::new());
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inner[start..at].trim();
                if !part.is_empty() {
                    paths.extend(expand(part).into_iter().map(|path| format!("{}{path}", prefix.trim())));
                }
                start = at + 1;
            }
            _ => {}
        }
    }
    paths
}

/// The paths that a module names: in `use` declarations and in its code.
fn names(code: &str) -> Vec<String> {
    let starts = code.match_indices("use ").filter(|(at, _)| {
        let before = code[..*at].rsplit('\n').next().unwrap().trim();
        before.is_empty() || before.starts_with("pub")
    });
    let declared = starts.map(|(at, start)| code[at + start.len()..].split(';').next().unwrap());
    let mut names: Vec<String> = declared.flat_map(expand).collect();
    for start in ["super::", "crate::"] {
        for (at, _) in code.match_indices(start) {
            if !code[..at].ends_with([':', '_']) {
                let path = code[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':');
                names.push(path.collect());
            }
        }
    }
    names
}

/// A path from the root.
fn absolute(module: &Module, path: &str, modules: &BTreeMap<Module, String>) -> Option<Module> {
    let mut parts: Vec<&str> = path.split("::").filter(|part| !part.is_empty()).collect();
    let mut base = module.clone();
    match *parts.first()? {
        "crate" => {
            base.truncate(1);
            parts.remove(0);
        }
        "super" | "self" => {
            while let Some(step @ ("super" | "self")) = parts.first().copied() {
                if step == "super" {
                    base.pop();
                }
                parts.remove(0);
            }
        }
        child => {
            let inner: Module = base.iter().cloned().chain([child.to_owned()]).collect();
            modules.get(&inner)?;
        }
    }
    base.extend(parts.into_iter().map(str::to_owned));
    Some(base)
}

/// The module in which a name is defined, re-exports followed.
fn home(name: &Module, modules: &BTreeMap<Module, String>, exports: &BTreeMap<Module, Module>) -> Module {
    let mut name = name.clone();
    for _ in 0..5 {
        let length = (0..=name.len()).rev().find(|&length| modules.contains_key(&name[..length])).unwrap_or(0);
        let Some(target) = name.get(..length + 1).and_then(|short| exports.get(short)) else {
            name.truncate(length);
            break;
        };
        name = target.clone();
    }
    name
}

#[test]
fn sibling_files_import_each_other_in_one_direction() {
    let modules = modules();
    let named: Vec<(&Module, Module)> = modules
        .iter()
        .flat_map(|(module, code)| names(code).into_iter().map(move |name| (module, name)))
        .filter_map(|(module, name)| Some((module, absolute(module, &name, &modules)?)))
        .collect();
    let exports: BTreeMap<Module, Module> = named
        .iter()
        .filter_map(|(module, target)| {
            let short: Module = module.iter().cloned().chain([target.last()?.clone()]).collect();
            (short != *target).then(|| (short, target.clone()))
        })
        .collect();
    let mut edges: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
    for (module, target) in &named {
        let target = home(target, &modules, &exports);
        let shared = module.iter().zip(&target).take_while(|(a, b)| a == b).count();
        if shared < module.len() && shared < target.len() {
            edges.entry(module[..=shared].to_vec()).or_default().insert(target[..=shared].to_vec());
        }
    }
    assert!(edges.values().map(BTreeSet::len).sum::<usize>() > 200, "the walk found only {edges:?}");
    // Modules without imports are removed again and again, until only circles remain.
    loop {
        let before = edges.len();
        let left: BTreeSet<Module> = edges.keys().cloned().collect();
        edges.retain(|_, targets| targets.iter().any(|target| left.contains(target)));
        if edges.len() == before {
            break;
        }
    }
    assert!(edges.is_empty(), "in circles, or above one: {edges:#?}");
}
