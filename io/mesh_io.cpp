#include "io/mesh_io.h"

#include <optional>
#include <string>
#include <string_view>

#include "geom/check.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "io/input_file.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "io/text_cursor.h"

namespace io {

namespace {

std::string_view name_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return "OBJ";
    case MeshFormat::off:
      return "OFF";
    case MeshFormat::ply:
      return "PLY";
    case MeshFormat::stl:
      return "STL";
  }
  return "";
}

/// The format that the first words give away, if they do.
std::optional<MeshFormat> recognise(const InputFile& file) {
  if (is_binary_stl(file.bytes)) return MeshFormat::stl;
  TextCursor cursor(file);
  if (!cursor.next_line()) return std::nullopt;
  const std::string_view first = cursor.word();
  if (first == "ply") return MeshFormat::ply;
  if (is_off_header(first)) return MeshFormat::off;
  if (first == "solid") return MeshFormat::stl;
  for (const std::string_view statement : {"v", "vn", "vt", "f", "mtllib", "usemtl"})
    if (first == statement) return MeshFormat::obj;
  return std::nullopt;
}

geom::TriMesh parse(const InputFile& file, MeshFormat format, std::size_t* repeated) {
  switch (format) {
    case MeshFormat::obj:
      return parse_obj(file, repeated);
    case MeshFormat::off:
      return parse_off(file, repeated);
    case MeshFormat::ply:
      return parse_ply(file, repeated);
    case MeshFormat::stl:
      return parse_stl(file);
  }
  throw geom::Bug("read_mesh: no such format");
}

std::string to_bytes(const geom::TriMesh& mesh, MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return to_obj(mesh);
    case MeshFormat::off:
      return to_off(mesh);
    case MeshFormat::ply:
      return to_ply(mesh);
    case MeshFormat::stl:
      return to_stl(mesh);
  }
  throw geom::Bug("write_mesh: no such format");
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, const geom::InputError& unfit) {
  throw geom::InputError("cannot write " + display_name(path) + ": " + unfit.what());
}

std::string to_bytes(const geom::TriMesh& mesh, const std::filesystem::path& path) try {
  return to_bytes(mesh, mesh_format(path));
} catch (const geom::InputError& unfit) {
  fail_to_write(path, unfit);
}

}  // namespace

MeshFormat mesh_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  fail_extension(path, "meshes are .obj, .off, .ply or .stl");
}

namespace {

geom::TriMesh read(const std::filesystem::path& path, std::size_t* repeated) {
  const InputFile file = load(path);
  const MeshFormat format = mesh_format(path);
  if (const auto seen = recognise(file); seen && *seen != format)
    file.fail({1, Unit::line}, "the extension says " + std::string(name_of(format)) + ", the content is " +
                                   std::string(name_of(*seen)));
  return parse(file, format, repeated);
}

}  // namespace

geom::TriMesh read_mesh(const std::filesystem::path& path) { return read(path, nullptr); }

geom::TriMesh read_mesh(const std::filesystem::path& path, std::size_t& repeated) {
  return read(path, &repeated);
}

void require_mesh(const std::filesystem::path& path, const geom::TriMesh& mesh) try {
  if (mesh_format(path) == MeshFormat::stl) require_stl(mesh);
} catch (const geom::InputError& unfit) {
  fail_to_write(path, unfit);
}

void require_edges(const std::filesystem::path& path, const geom::TriMesh& surface, double edge) try {
  if (mesh_format(path) == MeshFormat::stl) require_stl_edges(surface, edge);
} catch (const geom::InputError& unfit) {
  fail_to_write(path, unfit);
}

void write_mesh(const std::filesystem::path& path, const geom::TriMesh& mesh) {
  mesh_format(path);
  AtomicFile file(path);
  file.write(to_bytes(mesh, path)).commit();
}

}  // namespace io
