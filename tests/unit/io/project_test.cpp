#include "core/io/project.h"
#include "core/io/project_text.h"

#include "core/document/command_table.h"
#include "core/image/compare.h"
#include "core/image/image_io.h"
#include "core/io/ora_file.h"
#include "core/io/stack_xml.h"

#include "tests/unit/io/projects.h"

#include <cstdlib>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// Everything that a person could tell apart.
void expect_same(Session& again, Session& session) {
  EXPECT_EQ(again.document(), session.document());
  EXPECT_EQ(again.history().cursor(), session.history().cursor());
  ASSERT_EQ(again.history().entries().size(), session.history().entries().size());
  for (std::size_t i = 0; i < session.history().entries().size(); ++i) {
    const auto &now = again.history().entries()[i], &then = session.history().entries()[i];
    EXPECT_EQ(now.label, then.label) << i;
    EXPECT_EQ(now.document, then.document) << i;
    EXPECT_EQ(name_of(now.command), name_of(then.command)) << i;
  }
  const auto now = again.composite(), then = session.composite();
  ASSERT_EQ(now.ok(), then.ok());
  if (now) EXPECT_EQ(*now, *then);
}

TEST(Project, what_cannot_be_saved_or_opened_is_an_error) {
  const TempFolder folder;
  Session none;
  EXPECT_EQ(save_project(none, folder / "a.ora").error().code, "document.none");
  Session session = small_session();
  EXPECT_EQ(save_project(session, folder / "no/such/a.ora").error().code, "file.write");
  EXPECT_EQ(load_project(folder / "none.ora").error().code, "file.missing");
  EXPECT_EQ(load_project(folder.path()).error().code, "file.unreadable");
  folder.write("text.ora", "this is no archive, however long it is");
  EXPECT_EQ(load_project(folder / "text.ora").error().code, "project.not-an-archive");
  folder.write("empty.ora", "");
  EXPECT_EQ(load_project(folder / "empty.ora").error().code, "project.not-an-archive");
  EXPECT_EQ(load_project("/dev/zero").error().code, "file.unreadable");
}

TEST(Project, opens_as_it_was_whatever_was_done) {
  const TempFolder folder;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Image target = seed % 3 == 0 ? translucent_image(90, 80) : wavy_image(90, 80, 1);
    Session session = random_session(seed, 40, target);
    if (!session.composite()) continue;
    save(session, folder / "a.ora");
    Session again = load(folder / "a.ora");
    EXPECT_FALSE(again.history().modified());
    expect_same(again, session);
    // Back to the beginning and forth again, each picture as it was.
    while (session.history().can_undo()) {
      ASSERT_TRUE(session.undo().ok());
      ASSERT_TRUE(again.undo().ok());
      const auto then = session.composite(), now = again.composite();
      ASSERT_EQ(now.ok(), then.ok());
      if (now) ASSERT_EQ(*now, *then) << "at " << session.history().cursor();
    }
    while (session.history().can_redo())
      ASSERT_TRUE(session.redo().ok() && again.redo().ok());
    expect_same(again, session);
  }
}

TEST(Project, work_goes_on_after_opening_as_it_would_have_without) {
  const TempFolder folder;
  Session session = small_session();
  save(session, folder / "a.ora");
  Session again = load(folder / "a.ora");
  for (Session* each : {&session, &again}) {
    must_run(*each, PinMove{{}, {1}, {}, Point{86, 46}});
    must_run(*each, LayerMove{{}, {3, 2}});
    must_run(*each, LayerAdd{{std::string(kTargetName), {}}, {}});
  }
  expect_same(again, session);
  EXPECT_TRUE(again.history().modified());
  EXPECT_EQ(again.document().next_pin, session.document().next_pin);
  ASSERT_TRUE(again.undo(3).ok());
  EXPECT_FALSE(again.history().modified());
  // The log is the script of all of it.
  Session replay;
  for (const Step& step : session.log())
    must_run(replay, std::get<Command>(step));
  expect_same(replay, session);
}

TEST(Project, every_setting_comes_back) {
  const TempFolder folder;
  // One value for each field of the table, so that a new field is held here as soon as it is in the table.
  for (const CommandInfo& info : command_table()) {
    if (info.name != "layer.set") continue;
    for (const FieldInfo& field : info.fields) {
      if (field.name == "layer") continue;
      std::string value = field.type == "true or false" ? "false" : "1";
      if (!field.choices.empty()) value = "\"" + std::string(field.choices.back()) + "\"";
      if (field.type == "number") value = field.high <= 1 ? "0.375" : "7.5";
      SCOPED_TRACE(std::string(field.name) + " = " + value);
      Session session = small_session();
      const auto command = parse_command("{\"do\": \"layer.set\", \"" + std::string(field.name) + "\": " + value + "}");
      ASSERT_TRUE(command.ok()) << to_string(command.error());
      must_run(session, *command);
      EXPECT_NE(session.document().layers[0].settings, LayerSettings{});
      save(session, folder / "a.ora");
      Session again = load(folder / "a.ora");
      expect_same(again, session);
    }
  }
}

TEST(Project, pictures_of_any_precision_come_back_to_the_bit_and_stand_there_once) {
  const TempFolder folder;
  Raster<Rgba> wild(30, 20, {2.5f, -0.25f, 1e-30f, 0.3f});
  wild.at(3, 4) = {-0.0f, 1e30f, 0.1f, 1};
  for (const Image& target : {rounded(wavy_image(60, 50, 1), 255), rounded(wavy_image(60, 50, 1), 65535),
                              wavy_image(60, 50, 1), translucent_image(60, 50), Image(std::move(wild))}) {
    Session session = begun_with(target);
    must_run(session, LayerAdd{loaded_ref("twin.png", Image(Raster<Rgba>(target.pixels()))), {}});
    must_run(session, LayerAdd{{std::string(kTargetName), {}}, {}});
    save(session, folder / "a.ora");
    Session again = load(folder / "a.ora");
    const auto same_bits = [](const Image& a, const Image& b) { return a.content_hash() == b.content_hash(); };
    EXPECT_TRUE(same_bits(again.document().target.image, target));
    EXPECT_TRUE(same_bits(again.document().layers[0].source.image, target));
    EXPECT_EQ(&again.document().layers[0].source.image.pixels(), &again.document().target.image.pixels());
  }
}

TEST(Project, equal_sessions_make_equal_files_that_name_no_folder) {
  const TempFolder folder;
  for (const char* name : {"a.ora", "b.ora"}) {
    Session session = small_session();
    SaveOptions options;
    options.threads = name[0] == 'a' ? 1 : 3;
    save(session, folder / name, options);
  }
  EXPECT_EQ(folder.read("a.ora"), folder.read("b.ora"));
  const auto archive = Archive::open(folder / "a.ora", {});
  ASSERT_TRUE(archive.ok());
  const auto json = *archive->read("oversketch/document.json", 1 << 20);
  const std::string text(reinterpret_cast<const char*>(json.data()), json.size());
  EXPECT_EQ(text.find("some/folder"), std::string::npos);
  EXPECT_NE(text.find("target.png"), std::string::npos);
}

TEST(Project, the_file_begins_with_its_type_stored) {
  const TempFolder folder;
  Session session = small_session();
  save(session, folder / "a.ora");
  const std::string bytes = folder.read("a.ora");
  EXPECT_EQ(bytes.substr(30, 24), "mimetypeimage/openraster");
  EXPECT_EQ(bytes.substr(8, 2), std::string(2, '\0')) << "stored, not packed";
}

TEST(Project, a_file_that_is_saved_again_leaves_the_one_before_as_backup) {
  const TempFolder folder;
  Session session = small_session();
  save(session, folder / "a.ora");
  const std::string first = folder.read("a.ora");
  must_run(session, LayerMove{{}, {4, 4}});
  save(session, folder / "a.ora");
  EXPECT_EQ(folder.read("a.ora~"), first);
  EXPECT_NE(folder.read("a.ora"), first);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2);
}

TEST(Project, a_stop_is_heard_and_the_old_file_stays) {
  const TempFolder folder;
  Session session = small_session();
  save(session, folder / "a.ora");
  const std::string first = folder.read("a.ora");
  const auto contents = gather_project(session);
  ASSERT_TRUE(contents.ok());
  std::stop_source source;
  Watch watch;
  watch.stop = source.get_token();
  std::vector<std::string> stages;
  watch.progress = [&](double, std::string_view stage) {
    stages.emplace_back(stage);
    if (stage == "writing") source.request_stop();
  };
  // The first stop comes while the file is being written, the second before anything is.
  EXPECT_EQ(write_project(*contents, folder / "a.ora", {}, watch).error().code, "cancelled");
  EXPECT_EQ(write_project(*contents, folder / "a.ora", {}, watch).error().code, "cancelled");
  EXPECT_EQ(stages.front(), "packing pictures");
  EXPECT_EQ(folder.read("a.ora"), first);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  EXPECT_EQ(load_project(folder / "a.ora", {}, watch).error().code, "cancelled");
}

TEST(Project, a_history_that_is_cut_keeps_the_present_and_what_led_there) {
  const TempFolder folder;
  Session session = small_session();
  for (int i = 0; i < 6; ++i)
    must_run(session, PinMove{{}, {1}, {}, Point{86.0 - i, 44.0 + i}});
  ASSERT_TRUE(session.undo(2).ok());
  for (const std::size_t steps : {1, 3, 5}) {
    SaveOptions options;
    options.history.steps = steps;
    save(session, folder / "a.ora", options);
    Session again = load(folder / "a.ora");
    EXPECT_EQ(again.history().entries().size(), steps);
    EXPECT_EQ(again.document(), session.document());
    EXPECT_EQ(picture_of(again), picture_of(session)) << "solved through the steps that were cut";
  }
  SaveOptions options;
  options.history.image_bytes = 0;
  must_run(session, TargetSet{loaded_ref("other.png", wavy_image(100, 100, 3))});
  save(session, folder / "a.ora", options);
  EXPECT_EQ(load(folder / "a.ora").history().entries().size(), 1u) << "the step before has another target";
}

TEST(Project, what_is_saved_can_be_opened_again) {
  const TempFolder folder;
  Session session = small_session();
  for (int i = 0; i < 40; ++i)
    must_run(session, SketchSet{{}, blob({60, 42.0 + 0.1 * i}, 27)});
  ASSERT_TRUE(session.undo(3).ok());
  SaveOptions options;
  save(session, folder / "whole.ora", options);
  const auto archive = Archive::open(folder / "whole.ora", {});
  const std::size_t whole = archive->read("oversketch/document.json", 1 << 24)->size();

  LoadOptions reader;
  reader.limits.json_bytes = options.limits.json_bytes = whole / 2;
  save(session, folder / "a.ora", options);
  auto again = load_project(folder / "a.ora", reader);
  ASSERT_TRUE(again.ok()) << to_string(again.error());
  EXPECT_GT(again->session.history().entries().size(), 5U);
  EXPECT_LT(again->session.history().entries().size(), session.history().entries().size());
  EXPECT_EQ(again->session.document(), session.document());
  EXPECT_EQ(picture_of(again->session), picture_of(session));
  ASSERT_TRUE(again->session.redo(3).ok());

  const std::string good = folder.read("a.ora");
  for (const auto spoil :
       {+[](IoLimits& limits) { limits.json_bytes = 1000; }, +[](IoLimits& limits) { limits.xml_bytes = 100; },
        +[](IoLimits& limits) { limits.entries = 5; }, +[](IoLimits& limits) { limits.file_bytes = 1000; }}) {
    options.limits = {};
    spoil(options.limits);
    const auto refused = save_project(session, folder / "a.ora", options);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, "project.too-large");
    EXPECT_EQ(folder.read("a.ora"), good);
  }
}

TEST(Project, names_make_sound_xml) {
  const TempFolder folder;
  Session session = small_session();
  must_run(session, LayerRename{{}, "a\xEF\xBF\xBE\xEF\xBF\xBF\x01z"});
  save(session, folder / "a.ora");
  const auto stack = Archive::open(folder / "a.ora", {})->read("stack.xml", 10'000);
  const std::string text(reinterpret_cast<const char*>(stack->data()), stack->size());
  EXPECT_NE(text.find("a   z"), std::string::npos) << text;
  EXPECT_EQ(load(folder / "a.ora").document(), session.document()) << "the name itself stays";
}

TEST(Project, a_version_is_a_whole_number) {
  for (const char* newer : {"{\"version\":2,", "{\"version\": 12 ,", "{\"version\":2}"})
    EXPECT_GT(peek_project_version(newer).value(), 1) << newer;
  for (const char* none : {"{\"version\":1.5,", "{\"version\":0,", "{\"version\":1e3,",
                           "{\"version\":", "{\"other\":1,", "{\"version\":-1,", "{\"version\":99999999999999999999,"})
    EXPECT_EQ(peek_project_version(none).error().code, "project.damaged") << none;
}

TEST(Project, a_newer_project_is_shown_and_never_written_over) {
  const TempFolder folder;
  Session session = small_session();
  save(session, folder / "a.ora");
  auto parts = parts_of(folder / "a.ora", {"mimetype", "stack.xml", "mergedimage.png", "data/background.png",
                                           "data/layer1.png", "oversketch/document.json"});
  parts.back().bytes = bytes_of_text("{\"version\":2,\"something\":[\"else\"]}");
  write_parts(folder / "a.ora", std::move(parts));
  const std::string newer = folder.read("a.ora");
  auto loaded = load_project(folder / "a.ora");
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_TRUE(loaded->read_only);
  EXPECT_FALSE(loaded->foreign);
  EXPECT_NE(loaded->message.find("newer"), std::string::npos);
  EXPECT_LE(compare(picture_of(loaded->session), picture_of(session))->max_levels, 0.5);
  EXPECT_EQ(save_project(loaded->session, folder / "a.ora").error().code, "project.newer");
  EXPECT_EQ(folder.read("a.ora"), newer);
}

/// One file of every version that was released, as it was written then.
TEST(Project, files_of_every_version_still_open) {
  const fs::path released = fs::path(OVERSKETCH_SOURCE_DIR) / "tests/data/projects";
  int found = 0;
  for (const auto& entry : fs::directory_iterator(released)) {
    if (entry.path().extension() != ".ora") continue;
    SCOPED_TRACE(entry.path().string());
    ++found;
    Session again = load(entry.path());
    ASSERT_EQ(again.history().entries().size(), 6u);
    EXPECT_EQ(again.history().entries()[3].label, "Sketch");
    EXPECT_EQ(again.document().layers.at(0).pins.size(), 1u);
    const Image merged = *load_project_picture(entry.path());
    EXPECT_LE(compare(picture_of(again), merged)->max_levels, 2) << "solvers may have changed since, a little";
  }
  EXPECT_EQ(found, 1);
}

} // namespace
} // namespace oversketch
