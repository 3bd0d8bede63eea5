#include "tests/tools/faults.h"

#include <algorithm>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "tests/fixtures/sample_sets.h"

namespace faults {

using fixtures::ProgramResult;
using fixtures::ScratchFolder;

Job remesh_job(const std::vector<std::string>& more, std::size_t samples) {
  Job job{"fpo-remesh",
          {"torus.obj", "-n", std::to_string(samples), "-o", "@out.ply", "--points", "@out.xyz", "--map",
           "@map.txt", "--rpd", "@rpd.obj"},
          {"out.xyz", "map.txt", "rpd.obj", "out.ply"},
          true,
          samples};
  job.arguments.insert(job.arguments.end(), more.begin(), more.end());
  return job;
}

std::vector<Job> all_jobs() {
  std::vector<Job> jobs{
      remesh_job({"--iterations", "10"}),
      remesh_job({"--engine", "triangulation", "--iterations", "10"}),
      remesh_job({"--sizing", "lfs", "--iterations", "10"}),
      remesh_job({"--features", "20", "--iterations", "10"}),
      remesh_job({"--method", "cvt", "--iterations", "5"}),
      remesh_job({"--method", "mps"}),
      remesh_job({"--method", "cps"}),
      {"fpo-plane",
       {"-n", "3000", "-o", "@out.txt", "--log", "@log.csv"},
       {"log.csv", "out.txt"},
       true,
       3000},
      {"fpo-plane",
       {"-n", "200", "--bounded", "--iterations", "10", "-o", "@out.txt", "--log", "@log.csv"},
       {"log.csv", "out.txt"},
       true,
       200},
      {"fpo-spectrum",
       {"noise.txt", "noise.txt", "-o", "@s", "--radius", "4", "--max-frequency", "2"},
       {"s.csv", "s.svg"},
       true,
       0},
      {"fpo-quality", {"torus.obj", "--reference", "torus.obj"}, {}, false, 0},
      {"fpo-shape", {"torus", "--size", "60", "-o", "@out.obj"}, {"out.obj"}, false, 0},
      {"fpo-trace", {"torus.obj", "-n", "200", "--move", "30", "-o", "@"}, {}, false, 0}};
  for (const char* stage : {"before", "removed", "after", "there-before", "there-after"})
    for (const char* extension : {".svg", ".obj"})
      jobs.back().outputs.push_back(std::string(stage) + extension);
  for (Job& job : jobs)  // with mps and cps about as many samples
    if (std::ranges::count(job.arguments, "mps") + std::ranges::count(job.arguments, "cps") > 0)
      job.samples = 0;
  return jobs;
}

Workplace::Workplace() {
  io::write_mesh(folder_ / "torus.obj", geom::make_shape("torus", 14));
  io::write_points(folder_ / "noise.txt", fixtures::random_in_square(400, 1));
}

ProgramResult Workplace::run(const Job& job, const fixtures::Conditions& conditions,
                             const std::string& folder) const {
  std::vector<std::string> arguments = job.arguments;
  for (std::string& argument : arguments)
    if (argument.starts_with('@')) argument.replace(0, 1, folder + "/");
  return fixtures::run_program(job.program, arguments, folder_.path(), 120, conditions);
}

std::map<std::string, std::string> Workplace::files(const std::string& folder) const {
  std::map<std::string, std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
    if (entry.is_regular_file()) result[entry.path().filename().string()] = ScratchFolder::read(entry.path());
  return result;
}

std::map<std::string, std::string> Workplace::take_outputs(const Job& job) const {
  std::map<std::string, std::string> result;
  for (const std::string& name : job.outputs) {
    if (!std::filesystem::exists(folder_ / name)) continue;
    result[name] = ScratchFolder::read(folder_ / name);
    std::filesystem::remove(folder_ / name);
  }
  return result;
}

void check_whole(const Job& job, const std::map<std::string, std::string>& outputs) {
  const ScratchFolder elsewhere;
  CHECK(outputs.size() == job.outputs.size());
  for (const auto& file : outputs) {
    const auto& [name, bytes] = file;
    CAPTURE(file.first);
    const auto lines = static_cast<std::size_t>(std::ranges::count(bytes, '\n'));
    elsewhere.write(name, bytes);
    if (name.ends_with(".ply")) {
      const geom::TriMesh mesh = io::read_mesh(elsewhere / name);
      CHECK(mesh.num_facets() > 0);
      if (job.samples > 0) CHECK(mesh.num_vertices() == job.samples);
    } else if (name.ends_with(".svg")) {
      CHECK(bytes.ends_with("</svg>\n"));
    } else if (name == "out.xyz" || name == "out.txt" || name == "map.txt") {
      CHECK(bytes.ends_with("\n"));
      if (job.samples > 0) CHECK(lines == job.samples + (name == "map.txt" ? 1 : 0));  // the map has a head
    } else {
      CHECK(bytes.ends_with("\n"));
    }
  }
}

void check_one_line(const Job& job, const ProgramResult& result, const std::string& reason) {
  CHECK(result.code == 2);
  CHECK(result.lines_on_stderr() == 1);
  CHECK_MESSAGE(result.err.starts_with(job.program + ": "), result.err);
  CHECK_MESSAGE(result.err.find(reason) != std::string::npos, result.err);
}

}  // namespace faults
