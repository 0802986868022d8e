//! The shaders are valid, and the memory layout of the Rust structs matches theirs. The layout is read from the
//! shader compiler.

use std::mem::offset_of;

use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};
use wgpu::naga::{Binding, Module, ScalarKind, ShaderStage, TypeInner};

use super::geometry_buffers::Instance;
use super::mesh::Vertex;
use super::scene::{self, Scene};
use super::view::{self, View};

fn parse(source: &str) -> Module {
    wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

/// Size and members (name, offset) of a struct in a shader.
fn layout(module: &Module, name: &str) -> (usize, Vec<(String, usize)>) {
    let found = module.types.iter().find_map(|(_, ty)| match &ty.inner {
        TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
            let member =
                |member: &wgpu::naga::StructMember| (member.name.clone().unwrap_or_default(), member.offset as usize);
            Some((*span as usize, members.iter().map(member).collect()))
        }
        _ => None,
    });
    found.unwrap_or_else(|| panic!("no struct {name}"))
}

#[test]
fn every_shader_is_valid_without_extensions() {
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shaders")).unwrap() {
        let path = entry.unwrap().path();
        let module = parse(&std::fs::read_to_string(&path).unwrap());
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {error:?}", path.display()));
    }
}

#[test]
fn uniform_layouts_match_the_shaders() {
    let members = vec![("clip_from_base".into(), offset_of!(View, clip_from_base))];
    assert_eq!(layout(&parse(view::SHADER), "View"), (size_of::<View>(), members));
    let members = vec![
        ("clip_from_base".into(), offset_of!(Scene, clip_from_base)),
        ("light_from_base".into(), offset_of!(Scene, light_from_base)),
        ("toward_light".into(), offset_of!(Scene, toward_light)),
        ("eye_m".into(), offset_of!(Scene, eye_m)),
    ];
    assert_eq!(layout(&parse(scene::SHADER), "Scene"), (size_of::<Scene>(), members));
}

#[test]
fn vertex_inputs_match_the_buffers() {
    let buffers = [Vertex::LAYOUT, Instance::LAYOUT];
    assert_eq!(Vertex::LAYOUT.array_stride, 28);
    assert_eq!(Vertex::LAYOUT.attributes[2].offset, offset_of!(Vertex, color) as u64);
    assert_eq!(Instance::LAYOUT.attributes[3].offset, offset_of!(Instance, color) as u64);
    for source in [view::SHADER, scene::SHADER] {
        let module = parse(source);
        for entry in &module.entry_points {
            if entry.stage != ShaderStage::Vertex {
                continue;
            }
            let corner = &module.types[entry.function.arguments[0].ty].inner;
            let TypeInner::Struct { members, .. } = corner else {
                panic!("{} does not take a struct", entry.name);
            };
            for member in members {
                let Some(Binding::Location { location, .. }) = member.binding else {
                    panic!("{:?} has no location", member.name);
                };
                let attribute = buffers
                    .iter()
                    .flat_map(|buffer| buffer.attributes)
                    .find(|attribute| attribute.shader_location == location)
                    .unwrap_or_else(|| panic!("no attribute {location}"));
                let TypeInner::Vector { size, scalar } = module.types[member.ty].inner else {
                    panic!("{:?} is not a vector", member.name);
                };
                assert_eq!(scalar.kind, ScalarKind::Float);
                let components = match attribute.format {
                    wgpu::VertexFormat::Float32x3 => 3,
                    wgpu::VertexFormat::Float32x4 | wgpu::VertexFormat::Unorm8x4 => 4,
                    other => panic!("{other:?} is not checked here"),
                };
                assert_eq!(size as usize, components, "{:?}", member.name);
            }
        }
    }
}
