#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "commands.h"
#include "lab/experiments.h"
#include "lab/lab_json.h"
#include "lab/page.h"
#include "numbers.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"
#include "tenon/base/suggestion.h"

namespace tenon {

namespace {

using Json = nlohmann::ordered_json;

struct LabCommand {
  std::vector<std::string> wanted;
  std::string root = ".";
  std::string folder;
  std::string json_file;
  double scale = 1;
  bool quick = false, only_pages = false, quiet = false;

  Status run() const;

 private:
  LabEffort effort() const;
  Result<Json> measure(const Experiment& experiment, const Paper& paper, Lab& lab) const;
  Status write_pages() const;
};

Status write_file(const std::string& path, const std::string& bytes) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Status status = file->write(bytes); !status) return status;
  return file->commit();
}

Status make_folder(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (!failed) return success();
  return Error{ErrorKind::machine, "cannot make the folder '" + path + "': " + failed.message(), {}};
}

std::string to_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

// A paper's name stands for all of its tables; nothing for everything.
Result<std::vector<Experiment>> chosen_experiments(const std::vector<std::string>& wanted) {
  std::vector<Experiment> chosen;
  std::set<std::string> used;
  for (const Experiment& e : experiments()) {
    bool take = wanted.empty();
    for (const std::string& name : wanted) {
      if (name != e.id && name != e.paper) continue;
      take = true;
      used.insert(name);
    }
    if (take) chosen.push_back(e);
  }
  for (const std::string& name : wanted) {
    if (used.contains(name)) continue;
    std::vector<std::string_view> known;
    std::string there_are;
    for (const Experiment& e : experiments()) {
      for (const std::string_view word : {std::string_view(e.paper), std::string_view(e.id)}) {
        if (std::find(known.begin(), known.end(), word) != known.end()) continue;
        known.push_back(word);
        there_are += (there_are.empty() ? "" : ", ") + std::string(word);
      }
    }
    return usage_error("there is no table '" + name + "'" + suggestion(name, known) + "; there are: " + there_are);
  }
  return chosen;
}

// The papers of the experiments, each once, in their order.
Result<std::vector<Paper>> read_papers(const std::string& root, const std::vector<Experiment>& all) {
  std::vector<Paper> papers;
  for (const Experiment& e : all) {
    if (!papers.empty() && papers.back().id == e.paper) continue;
    Result<Paper> paper = read_paper(root + "/lab/papers", e.paper);
    if (!paper) return paper.error();
    papers.push_back(std::move(*paper));
  }
  return papers;
}

const Paper& paper_of(const Experiment& experiment, const std::vector<Paper>& papers) {
  return *std::find_if(papers.begin(), papers.end(), [&](const Paper& p) { return p.id == experiment.paper; });
}

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

LabEffort LabCommand::effort() const {
  LabEffort effort;
  if (quick) effort = {"quick", 0.25, 3, 1e4, 1};
  if (scale == 1) return effort;
  effort.name += " x " + shortest(scale);
  effort.scale *= scale;
  // Pictures of a twentieth are to see whether all goes well; of half, for a slow machine.
  if (scale < 0.5) effort.rounds = scale < 0.2 ? 1 : 3;
  effort.most_spheres = std::max(100.0, effort.most_spheres * scale * scale);
  effort.curve_seconds *= scale;
  return effort;
}

// Pages are of all tables that lie in the folder, whenever they were measured.
Status LabCommand::write_pages() const {
  const Result<std::vector<Paper>> papers = read_papers(root, experiments());
  if (!papers) return papers.error();
  std::vector<Json> tables;
  for (const Experiment& e : experiments()) {
    std::ifstream file(folder + "/data/" + e.id + ".json");
    if (!file) continue;
    Json table = Json::parse(file, nullptr, false);
    if (table.is_discarded()) {
      return Error{ErrorKind::input, folder + "/data/" + e.id + ".json is damaged; measure it again", {}};
    }
    tables.push_back(std::move(table));
  }
  for (const Paper& paper : *papers) {
    if (Status status = write_file(folder + "/" + paper.id + ".md", page_markdown(paper, tables)); !status) {
      return status;
    }
  }
  return write_file(folder + "/README.md", index_markdown(*papers, tables));
}

// One table: measured, and written where its page looks for it, so that it is kept whatever happens after.
Result<Json> LabCommand::measure(const Experiment& experiment, const Paper& paper, Lab& lab) const {
  const auto begun = std::chrono::steady_clock::now();
  const LabOrigin origin = find_origin(root);
  LabTable table;
  table.id = experiment.id;
  lab.expect(experiment.weight);
  if (Status status = experiment.run(lab, paper, table); !status) return status.error();
  Json json = lab_json(table, paper, origin, lab.effort().name, seconds_since(begun));
  if (folder.empty()) return json;
  for (const LabPicture& picture : table.pictures) {
    const Status status = write_file(folder + "/pictures/" + picture.name + ".png", picture.bytes);
    if (!status) return status.error();
  }
  if (Status status = write_file(folder + "/data/" + table.id + ".json", to_text(json)); !status) return status.error();
  return json;
}

Status LabCommand::run() const {
  if (only_pages) {
    if (folder.empty()) return usage_error("--pages writes the pages of a folder again; name it with -o");
    return write_pages();
  }
  const Result<std::vector<Experiment>> chosen = chosen_experiments(wanted);
  if (!chosen) return chosen.error();
  const Result<std::vector<Paper>> papers = read_papers(root, *chosen);
  if (!papers) return papers.error();
  for (const char* part : {"/data", "/plots", "/pictures"}) {
    if (folder.empty()) break;
    if (Status status = make_folder(folder + part); !status) return status;
  }
  Console console(quiet);
  Lab lab(root, effort(), console);
  double weights = 0;
  for (const Experiment& e : *chosen) weights += e.weight;
  lab.begin(weights);
  const bool prints = folder.empty() && json_file.empty();
  Json all = Json::array();
  for (const Experiment& e : *chosen) {
    Result<Json> table = measure(e, paper_of(e, *papers), lab);
    if (!table) return table.error();
    if (prints) {
      if (Status status = write_standard_output(table_markdown(paper_of(e, *papers), *table) + '\n'); !status)
        return status;
    }
    all.push_back(std::move(*table));
  }
  console.progress().end();
  if (!json_file.empty()) {
    const Status status = json_file == "-" ? write_standard_output(to_text(all)) : write_file(json_file, to_text(all));
    if (!status) return status;
  }
  return folder.empty() ? success() : write_pages();
}

}  // namespace

CommandBody add_lab_command(CLI::App& command) {
  const auto arguments = std::make_shared<LabCommand>();
  command.add_option("TABLE", arguments->wanted, "Papers or tables; all of them when nothing is named")->type_name("");
  command.add_flag("--quick", arguments->quick, "Smaller pictures and fewer rounds: minutes in place of half an hour");
  command
      .add_option("--scale", arguments->scale,
                  "Sides of pictures, by this factor; curves end sooner with it, and below 0.5 rounds are fewer")
      ->type_name("S")
      ->check(CLI::Range(0.01, 4.0).description("0.01 to 4"));
  command
      .add_option(
          "-o,--output", arguments->folder,
          "Write a page a paper (Markdown) to this folder, with the figures in data/ as JSON and pictures beside; "
          "plots are drawn from there by lab/plot.py. Otherwise the tables are printed")
      ->type_name("DIR");
  command.add_option("--json", arguments->json_file, "Write all tables to a JSON file; - for standard output")
      ->type_name("FILE");
  command.add_flag("--pages", arguments->only_pages,
                   "Measure nothing; write the pages again from the figures that lie in the folder of -o");
  command.add_option("--root", arguments->root, "The repository, whose scenes and paper figures are used")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  std::string footer = "Papers and their tables:";
  std::string paper;
  for (const Experiment& e : experiments()) {
    footer += paper == e.paper ? ", " : "\n  " + std::string(e.paper) + ": ";
    footer += e.id;
    paper = e.paper;
  }
  command.footer(footer + "\n\nEvery figure is measured here and now; the papers' figures come from lab/papers.");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
