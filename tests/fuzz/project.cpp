// Project files: a whole archive as it is, or, where the input is a text, one part of a sound archive in its place:
// stack.xml for what begins with '<', oversketch/document.json for all else.  What opens must stand saving and opening.

#include "core/io/project.h"
#include "core/base/file.h"
#include "core/io/archive.h"
#include "core/io/ora_file.h"
#include "core/io/project_text.h"

#include "tests/fuzz/documents.h"
#include "tests/fuzz/scratch.h"

#include <numbers>
#include <span>
#include <string>
#include <vector>

namespace oversketch::fuzz {
namespace {

namespace fs = std::filesystem;

IoLimits small_limits() {
  IoLimits limits;
  limits.file_bytes = 1 << 20;
  limits.memory_bytes = 32 << 20;
  limits.json_bytes = 1 << 18;
  limits.entries = 100;
  return limits;
}

Points round_curve(double radius) {
  Points points;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12;
    // Whole pixels, so that a text that a person reads has few digits.
    points.push_back({std::round(24 + radius * std::cos(angle)), std::round(20 + radius * std::sin(angle))});
  }
  return points;
}

Session example_session() {
  Session session;
  DocumentNew begin;
  begin.target = ImageRef{"target.png", striped_image(48, 40, 0)};
  LayerSet set;
  set.opacity = 0.5, set.mode = CloneMode::kMixed;
  for (const Command& command :
       {Command(begin), Command(LayerAdd{{"a.png", striped_image(50, 44, 1)}, std::nullopt}),
        Command(RegionSet{{}, round_curve(14)}), Command(SketchSet{{}, round_curve(11)}),
        Command(PinAdd{{}, {38, 20}, {35, 20}}), Command(set), Command(LayerMove{{}, {3, -2}})})
    MUST_HOLD(session.execute(command).ok(), "the example");
  MUST_HOLD(session.undo().ok(), "the example");
  return session;
}

class Project {
public:
  Project() {
    Session session = example_session();
    MUST_HOLD(save_project(session, sound_, {.threads = 1}).ok(), "the example is saved");
    const auto archive = Archive::open(sound_, {});
    MUST_HOLD(archive.ok(), "the example opens");
    const auto file = OraFile::open(sound_);
    std::vector<std::string> names{
        "mimetype",       "stack.xml", "mergedimage.png", "oversketch/document.json", "data/background.png",
        "data/layer1.png"};
    const auto text = archive->read("oversketch/document.json", 1 << 20);
    MUST_HOLD(text.ok(), "the example has a document");
    const std::string json(reinterpret_cast<const char*>(text->data()), text->size());
    const std::string folder = "oversketch/images/";
    for (std::size_t at = json.find(folder); at != std::string::npos; at = json.find(folder, at + 1))
      names.push_back(json.substr(at, json.find('"', at) - at));
    for (const std::string& name : names) {
      auto bytes = archive->read(name, 1 << 20);
      MUST_HOLD(bytes.ok(), name);
      parts_.push_back({name, std::move(*bytes), true});
    }
  }

  void run(std::string_view input) {
    const bool is_archive = input.starts_with("PK");
    scratch_.write("a.ora", is_archive ? std::string(input) : with_part(input));
    const LoadOptions options{small_limits(), 1};
    (void)read_project_version(scratch_ / "a.ora", options).ok();
    look_at_layers(options);
    auto loaded = load_project(scratch_ / "a.ora", options);
    if (!loaded) {
      MUST_HOLD(!loaded.error().code.empty() && !loaded.error().where.empty(), "an error tells the place");
      return;
    }
    check_session(loaded->session);
    MUST_HOLD(!loaded->session.history().modified(), "what was opened is unmodified");
    if (loaded->read_only || loaded->foreign) return;
    print_and_read(loaded->session.saved());
    // Saving solves and paints: of 16 inputs one, chosen by what it is.
    std::uint8_t sum = 0;
    for (const char c : input)
      sum = static_cast<std::uint8_t>(sum + c);
    if (sum % 16 == 0) save_and_open(loaded->session);
  }

private:
  std::string with_part(std::string_view text) const {
    const std::string name = text.starts_with('<') ? "stack.xml" : "oversketch/document.json";
    std::vector<ArchivePart> parts = parts_;
    for (ArchivePart& part : parts)
      if (part.name == name) {
        const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
        part.bytes.assign(bytes.begin(), bytes.end());
      }
    const auto archive = make_archive(std::move(parts));
    MUST_HOLD(archive.ok(), "parts make an archive");
    return {reinterpret_cast<const char*>(archive->data()), archive->size()};
  }

  void look_at_layers(const LoadOptions& options) const {
    const auto file = OraFile::open(scratch_ / "a.ora", options.limits);
    if (!file) return;
    for (std::size_t i = 0; i < std::min<std::size_t>(file->layers().size(), 4); ++i)
      (void)file->load_layer(i).ok();
    (void)file->load_picture().ok();
  }

  static void print_and_read(const SavedSession& saved) {
    auto pictures = pictures_of(saved);
    for (auto& [hash, picture] : pictures)
      picture.part = "p/" + to_string(hash);
    const std::string text = print_project(saved, pictures);
    const auto read = ProjectText::parse(text, {});
    MUST_HOLD(read.ok(), "what is printed can be read: " + (read.ok() ? "" : to_string(read.error())));
    std::vector<Image> images;
    for (const ProjectText::Picture& picture : read->pictures())
      images.push_back(pictures.at(picture.hash).image);
    const auto again = read->session(images);
    MUST_HOLD(again.ok(), "what is printed is sound: " + (again.ok() ? "" : to_string(again.error())));
    MUST_HOLD(again->steps.size() == saved.steps.size() && again->cursor == saved.cursor, "with its history");
    for (std::size_t i = 0; i < saved.steps.size(); ++i)
      MUST_HOLD(again->steps[i].document == saved.steps[i].document &&
                    again->steps[i].command == saved.steps[i].command,
                "each step as it was");
    MUST_HOLD(print_project(*again, pictures) == text, "and prints the same");
  }

  /// Solving may refuse what is valid (a cell larger than the region); what it does not refuse comes back as it was.
  void save_and_open(Session& session) {
    for (const Layer& layer : session.document().layers)
      if (layer.settings.iterations > 100 || layer.settings.cell_px < 2 || std::abs(layer.placement.factor) > 4) return;
    if (!save_project(session, scratch_ / "b.ora", {.threads = 1})) return;
    const auto again = load_project(scratch_ / "b.ora", {small_limits(), 1});
    MUST_HOLD(again.ok(), "what was saved opens: " + (again.ok() ? "" : to_string(again.error())));
    MUST_HOLD(again->session.document() == session.document(), "the document is as it was saved");
    MUST_HOLD(again->session.history().cursor() == session.history().cursor(), "and the cursor");
    MUST_HOLD(again->session.history().entries().size() == session.history().entries().size(), "and the history");
    for (std::size_t i = 0; i < session.history().entries().size(); ++i)
      MUST_HOLD(again->session.history().entries()[i].document == session.history().entries()[i].document,
                "each document of the history is as it was saved");
  }

  Scratch scratch_;
  fs::path sound_ = scratch_ / "sound.ora";
  std::vector<ArchivePart> parts_;
};

} // namespace
} // namespace oversketch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static oversketch::fuzz::Project project;
  project.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
