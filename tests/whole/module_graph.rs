//! Modules of a crate form no cycle.
//!
//! For every parent module, the graph of what its children's subtrees use from each other is acyclic; a child and its own
//! parent may use each other. Uses are read from the sources: `use` trees and paths that begin with `crate`, `self` or `super`,
//! followed through re-exports. Test modules do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The path of a module within its crate.
type Module = Vec<String>;

/// The modules of a crate with their text, and what each uses.
#[derive(Default)]
struct Crate {
    texts: BTreeMap<Module, String>,
    /// Names that `use` brings into a module, with what they stand for.
    names: BTreeMap<Module, BTreeMap<String, Module>>,
    uses: BTreeMap<Module, BTreeSet<Module>>,
}

impl Crate {
    fn read(src: &Path) -> Self {
        let mut graph = Self::default();
        let root = ["lib.rs", "main.rs"].map(|name| src.join(name));
        let root = root.iter().find(|path| path.exists()).unwrap();
        graph.add_module(root, &[], src);
        graph.find_uses();
        graph
    }

    fn of_text(modules: &[(&str, &str)]) -> Self {
        let mut graph = Self::default();
        for (module, text) in modules {
            let module = module.split("::").filter(|part| !part.is_empty());
            let module = module.map(str::to_owned).collect();
            graph.texts.insert(module, stripped(text));
        }
        graph.find_uses();
        graph
    }

    fn add_module(&mut self, file: &Path, module: &[String], folder: &Path) {
        let text = stripped(&fs::read_to_string(file).unwrap());
        for name in declared_modules(&text) {
            let files = [folder.join(format!("{name}.rs")), folder.join(&name).join("mod.rs")];
            if let Some(file) = files.iter().find(|file| file.exists()) {
                let child = [module, std::slice::from_ref(&name)].concat();
                self.add_module(file, &child, &folder.join(name));
            }
        }
        self.texts.insert(module.to_vec(), text);
    }

    fn find_uses(&mut self) {
        for (module, text) in self.texts.clone() {
            let (trees, rest) = use_trees(&text);
            for tree in trees {
                for (path, name) in expanded(&tree) {
                    if let Some(path) = self.absolute(&module, &path) {
                        let names = self.names.entry(module.clone()).or_default();
                        names.insert(name, path.clone());
                        self.uses.entry(module.clone()).or_default().insert(path);
                    }
                }
            }
            for path in inline_paths(&rest) {
                if let Some(path) = self.absolute(&module, &path) {
                    self.uses.entry(module.clone()).or_default().insert(path);
                }
            }
        }
    }

    /// A path as one from the root of the crate; `None` if it leads to another crate.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Module> {
        let mut from = match path.first()?.as_str() {
            "crate" => return Some(path[1..].to_vec()),
            "self" => return Some([module, &path[1..]].concat()),
            "super" => module.to_vec(),
            name => {
                let child = [module, &[name.to_owned()]].concat();
                return self.texts.contains_key(&child).then(|| [module, path].concat());
            }
        };
        let ups = path.iter().take_while(|part| *part == "super").count();
        from.truncate(from.len().checked_sub(ups)?);
        Some([&from, &path[ups..]].concat())
    }

    /// The module in which what `path` names is defined.
    fn home(&self, path: &[String], depth: usize) -> Module {
        let length = (0..=path.len()).rev().find(|&k| self.texts.contains_key(&path[..k]));
        let (module, rest) = path.split_at(length.unwrap_or(0));
        let reexported = rest.first().and_then(|name| self.names.get(module)?.get(name));
        match reexported {
            Some(target) if depth < 16 && target != path => {
                self.home(&[&target[..], &rest[1..]].concat(), depth + 1)
            }
            _ => module.to_vec(),
        }
    }

    /// All cycles, as the children of a parent that use each other.
    fn cycles(&self) -> Vec<String> {
        let parents: BTreeSet<Module> =
            self.texts.keys().filter_map(|m| Some(m.split_last()?.1.to_vec())).collect();
        parents.iter().filter_map(|parent| self.cycle_below(parent)).collect()
    }

    fn cycle_below(&self, parent: &[String]) -> Option<String> {
        let level = parent.len();
        let child = |module: &[String]| {
            (module.len() > level && module.starts_with(parent)).then(|| module[level].clone())
        };
        let mut edges: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (module, uses) in &self.uses {
            let Some(from) = child(module) else { continue };
            let targets = uses.iter().filter_map(|path| child(&self.home(path, 0)));
            edges.entry(from.clone()).or_default().extend(targets.filter(|to| *to != from));
        }
        // What only points outwards, or only is pointed at, is on no cycle.
        loop {
            let before = edges.len();
            let sources: BTreeSet<String> = edges.keys().cloned().collect();
            edges.retain(|_, targets| {
                targets.retain(|to| sources.contains(to));
                !targets.is_empty()
            });
            if edges.is_empty() {
                return None;
            }
            if edges.len() == before {
                let names: Vec<&String> = edges.keys().collect();
                return Some(format!("{}: among {names:?}", parent.join("::")));
            }
        }
    }
}

/// Without comments, the content of strings, and inline test modules.
fn stripped(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        if line.trim_start().starts_with("#[cfg(test)]") {
            out.push_str("#[cfg(test)]");
            continue;
        }
        let code = line.split("//").next().unwrap_or_default();
        let is_string = |(index, part): (usize, &str)| {
            if index % 2 == 0 { part.to_owned() } else { String::new() }
        };
        out.extend(code.split('"').enumerate().map(is_string));
        out.push('\n');
    }
    match out.find("#[cfg(test)]mod tests {") {
        Some(end) => out[..end].to_owned(),
        None => out,
    }
}

/// The modules that have their own files.
fn declared_modules(text: &str) -> Vec<String> {
    let declarations =
        text.lines().filter(|line| line.ends_with(';') && !line.contains("#[cfg(test)]"));
    let names = declarations.filter_map(|line| {
        line.split_once("mod ").filter(|(before, _)| before.is_empty() || before.starts_with("pub"))
    });
    names.map(|(_, name)| name.trim_end_matches(';').to_owned()).collect()
}

/// The trees of all `use` statements, and the text without them.
fn use_trees(text: &str) -> (Vec<String>, String) {
    let (mut trees, mut rest) = (Vec::new(), String::new());
    let mut text = text;
    while let Some(start) = text.find("use ") {
        let is_word = text[..start].chars().next_back().is_none_or(char::is_whitespace);
        let Some(end) = text[start..].find(';').filter(|_| is_word) else {
            rest.push_str(&text[..start + 4]);
            text = &text[start + 4..];
            continue;
        };
        rest.push_str(&text[..start]);
        trees.push(text[start + 4..start + end].split_whitespace().collect::<Vec<_>>().join(" "));
        text = &text[start + end..];
    }
    rest.push_str(text);
    (trees, rest)
}

/// The paths of a `use` tree, each with the name it brings.
fn expanded(tree: &str) -> Vec<(Vec<String>, String)> {
    let Some((before, inside)) = tree.split_once('{') else {
        let (path, alias) =
            tree.split_once(" as ").map_or((tree, None), |(path, name)| (path, Some(name)));
        let mut path: Vec<String> = path.split("::").map(|part| part.trim().to_owned()).collect();
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        let name = alias.map_or_else(
            || path.last().cloned().unwrap_or_default(),
            |name| name.trim().to_owned(),
        );
        return vec![(path, name)];
    };
    let inside = &inside[..inside.rfind('}').unwrap_or(inside.len())];
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for letter in inside.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if letter == ',' && depth == 0 {
            parts.push(String::new());
        } else if let Some(part) = parts.last_mut() {
            part.push(letter);
        }
    }
    let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
    parts.flat_map(|part| expanded(&format!("{before}{part}"))).collect()
}

/// Paths in code that begin at the crate, the module or its parent.
fn inline_paths(text: &str) -> Vec<Vec<String>> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let words = text.split(|c| !is_path(c));
    let paths = words.filter(|word| {
        ["crate::", "self::", "super::"].iter().any(|start| word.starts_with(start))
    });
    paths
        .map(|path| path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect())
        .collect()
}

#[test]
fn modules_of_no_crate_form_a_cycle() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut found = Vec::new();
    let mut modules = 0;
    for entry in fs::read_dir(crates).unwrap() {
        let folder = entry.unwrap().path();
        let graph = Crate::read(&folder.join("src"));
        modules += graph.texts.len();
        found.extend(
            graph.cycles().into_iter().map(|cycle| format!("{}: {cycle}", folder.display())),
        );
    }
    assert!(modules > 400, "{modules}");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_cycle_is_found_through_reexports_inline_paths_and_modules_of_modules() {
    let direct =
        [("", "mod a; mod b;"), ("a", "use crate::b::{X, Y};"), ("b", "fn f() { super::a::g() }")];
    assert_eq!(Crate::of_text(&direct).cycles().len(), 1);
    let reexported = [("", "pub use b::X;"), ("a", "use crate::X;"), ("b", "use super::a::f;")];
    assert_eq!(Crate::of_text(&reexported).cycles().len(), 1);
    let deeper = [
        ("", ""),
        ("a", ""),
        ("a::c", "use crate::b::X;"),
        ("a::d", ""),
        ("b", "use crate::a::d::Y;"),
    ];
    assert_eq!(Crate::of_text(&deeper).cycles().len(), 1);
    let parent_and_child =
        [("", ""), ("a", "use self::c::X;"), ("a::c", "use super::Y;"), ("b", "use crate::a::Y;")];
    assert_eq!(Crate::of_text(&parent_and_child).cycles(), Vec::<String>::new());
    let only_in_tests = [
        ("", ""),
        ("a", "#[cfg(test)]\nmod tests {\n use crate::b::X;\n}"),
        ("b", "use crate::a::Y;"),
    ];
    assert_eq!(Crate::of_text(&only_in_tests).cycles(), Vec::<String>::new());
}
