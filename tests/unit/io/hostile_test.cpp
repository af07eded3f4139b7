// Project files that mean harm, or were harmed: a clear error that names the part, nothing more.

#include "core/image/image_io.h"
#include "core/io/ora_file.h"
#include "core/io/stack_xml.h"

#include "tests/support/effort.h"
#include "tests/unit/io/projects.h"

#include <nlohmann/json.hpp>

#include <random>

namespace oversketch {
namespace {

using namespace testing;
using Json = nlohmann::ordered_json;

constexpr const char* kDocument = "oversketch/document.json";

/// A good project whose parts a test spoils.
class Hostile : public ::testing::Test {
protected:
  Hostile() {
    Session session = small_session();
    save(session, folder / "good.ora");
    std::vector<std::string> names{"mimetype",        "stack.xml",  kDocument, "mergedimage.png", "data/background.png",
                                   "data/layer1.png", source_part()};
    parts = parts_of(folder / "good.ora", names);
  }

  static std::string source_part() {
    return "oversketch/images/" + to_string(rounded(wavy_image(100, 90, 2), 255).content_hash()) + ".png";
  }
  ArchivePart& part(const std::string& name) {
    return *std::find_if(parts.begin(), parts.end(), [&](const ArchivePart& each) { return each.name == name; });
  }
  std::string text_of(const std::string& name) {
    const auto& bytes = part(name).bytes;
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  void set_text(const std::string& name, const std::string& text) { part(name).bytes = bytes_of_text(text); }
  void replace_in(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = text_of(name);
    const auto found = text.find(from);
    ASSERT_NE(found, std::string::npos) << from;
    set_text(name, text.replace(found, from.size(), to));
  }
  /// The error with which the spoilt project is refused.
  Error refusal(const LoadOptions& options = {}) {
    write_parts(folder / "bad.ora", parts);
    return refusal_of(options);
  }
  Error refusal_of(const LoadOptions& options = {}) {
    const auto loaded = load_project(folder / "bad.ora", options);
    if (!loaded) EXPECT_EQ(loaded.error().where.find((folder / "bad.ora").string()), 0u) << to_string(loaded.error());
    return loaded.ok() ? Error{"accepted", "", ""} : loaded.error();
  }
  /// The archive's bytes with each `from` changed to `to`.
  std::string patched(std::string bytes, const std::string& from, const std::string& to) {
    int count = 0;
    for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; at += to.size(), ++count)
      bytes.replace(at, from.size(), to);
    EXPECT_GT(count, 0) << from;
    return bytes;
  }
  /// Sets bytes in the directory's entry of a part (its header is 46 bytes before the name).
  std::string with_directory(std::string bytes, const std::string& name, std::size_t offset, const std::string& value) {
    const std::size_t at = bytes.rfind(name);
    EXPECT_NE(at, std::string::npos);
    EXPECT_EQ(bytes.substr(at - 46, 4), "PK\1\2");
    return bytes.replace(at - 46 + offset, value.size(), value);
  }

  TempFolder folder;
  std::vector<ArchivePart> parts;
};

TEST_F(Hostile, a_good_project_is_accepted) {
  EXPECT_EQ(refusal().code, "accepted");
}

TEST_F(Hostile, names_that_lead_elsewhere_are_refused) {
  for (const char* name : {"/etc/passwd", "../up", "data/../../up", "data/..", "./here", "data//two", "back\\slash",
                           "C:drive", "line\nfeed", ".."}) {
    auto more = parts;
    more.push_back({name, bytes_of_text("x"), true});
    write_parts(folder / "bad.ora", std::move(more));
    EXPECT_EQ(refusal_of().code, "project.bad-name") << name;
  }
  auto more = parts;
  more.push_back({std::string(600, 'a'), bytes_of_text("x"), true});
  write_parts(folder / "bad.ora", std::move(more));
  EXPECT_EQ(refusal_of().code, "project.bad-name");
  // What a folder's own entry is called.
  parts.push_back({"data/", {}, true});
  EXPECT_EQ(refusal().code, "accepted");
}

TEST_F(Hostile, parts_that_stand_there_twice_links_and_locked_ones_are_refused) {
  parts.push_back({"stack.xmm", bytes_of_text("<image/>"), true});
  write_parts(folder / "bad.ora", parts);
  const std::string good = folder.read("bad.ora");
  folder.write("bad.ora", patched(good, "stack.xmm", "stack.xml"));
  EXPECT_EQ(refusal_of().code, "project.bad-name");
  // Made on Unix (3), and of the kind of a link.
  folder.write("bad.ora", with_directory(with_directory(good, "stack.xmm", 5, "\3"), "stack.xmm", 38,
                                         std::string("\0\0\xff\xa1", 4)));
  EXPECT_EQ(refusal_of().code, "project.bad-name");
  folder.write("bad.ora", with_directory(good, kDocument, 8, "\1"));
  EXPECT_EQ(refusal_of().code, "project.encrypted");
}

TEST_F(Hostile, sizes_that_are_not_true_are_found_out) {
  part(kDocument).packed = false;
  write_parts(folder / "bad.ora", parts);
  const std::string good = folder.read("bad.ora");
  for (const auto& size : {std::string("\x01\0\0\0", 4), std::string("\xff\0\0\0", 4), std::string("\0\0\1\0", 4)}) {
    folder.write("bad.ora", with_directory(good, kDocument, 24, size));
    EXPECT_EQ(refusal_of().code, "project.damaged");
  }
  folder.write("bad.ora", with_directory(good, kDocument, 24, "\xff\xff\xff\x7f"));
  EXPECT_EQ(refusal_of().code, "project.too-large");
}

TEST_F(Hostile, bombs_do_not_go_off) {
  const LoadOptions usual;
  part(kDocument) = {kDocument, std::vector<std::byte>(usual.limits.json_bytes + 1, std::byte{' '}), false};
  EXPECT_EQ(refusal().code, "project.too-large");
  EXPECT_NE(refusal().where.find(kDocument), std::string::npos);
  part(kDocument) = parts_of(folder / "good.ora", {kDocument})[0];
  part("stack.xml") = {"stack.xml", std::vector<std::byte>(usual.limits.xml_bytes + 1, std::byte{' '}), false};
  // A foreign file, so that the stack is read.
  std::erase_if(parts, [](const ArchivePart& each) { return each.name == kDocument; });
  EXPECT_EQ(refusal().code, "project.too-large");

  std::vector<ArchivePart> many;
  for (std::int64_t i = 0; i <= usual.limits.entries; ++i)
    many.push_back({"part" + std::to_string(i), {}, true});
  write_parts(folder / "bad.ora", std::move(many));
  EXPECT_EQ(refusal_of().code, "project.too-large");
}

TEST_F(Hostile, a_directory_that_lies_about_its_length_is_damage) {
  const std::string good = folder.read("good.ora");
  const std::size_t end = good.rfind("PK\5\6");
  for (const std::size_t at : {8u, 10u, 12u, 16u}) {
    std::string bad = good;
    bad.replace(end + at, 2, "\xff\xff");
    folder.write("bad.ora", bad);
    EXPECT_EQ(refusal_of().code, "project.damaged") << at;
  }
}

TEST_F(Hostile, pictures_of_giants_are_refused_before_they_are_decoded) {
  // Width and height in the header of a PNG.
  auto& png = part(source_part()).bytes;
  for (const std::size_t at : {16u, 20u})
    std::fill_n(png.begin() + static_cast<std::ptrdiff_t>(at), 3, std::byte{0x7f});
  EXPECT_EQ(refusal().code, "image.too-large");
  EXPECT_NE(refusal().where.find(source_part()), std::string::npos);
  LoadOptions little;
  little.limits.memory_bytes = 300'000;
  parts = parts_of(folder / "good.ora", {"mimetype", kDocument, "data/background.png", source_part()});
  EXPECT_EQ(refusal(little).code, "project.too-large");
  EXPECT_EQ(refusal().code, "accepted");
}

TEST_F(Hostile, another_picture_in_the_place_of_one_is_noticed) {
  const std::string kept = source_part();
  part(kept).bytes = *encode_png(wavy_image(100, 90, 2.01));
  EXPECT_EQ(refusal().code, "project.damaged");
  EXPECT_NE(refusal().where.find(kept), std::string::npos);
  part(kept).bytes = *encode_png(wavy_image(90, 100, 2));
  EXPECT_EQ(refusal().code, "project.damaged");
  part(kept).bytes = bytes_of_text("\xff\xd8\xff: no PNG");
  EXPECT_EQ(refusal().code, "image.unknown-format");
  std::erase_if(parts, [&](const ArchivePart& each) { return each.name == kept; });
  EXPECT_EQ(refusal().code, "project.missing-part");
}

TEST_F(Hostile, a_project_reads_nothing_outside_itself) {
  folder.write("secret.png", "not yours");
  for (const char* path : {"../secret.png", "/etc/passwd", "secret.png"}) {
    set_text(kDocument, text_of(kDocument));
    auto spoilt = parts;
    Json json = Json::parse(text_of(kDocument));
    json["pictures"][0]["part"] = path;
    set_text(kDocument, json.dump());
    EXPECT_EQ(refusal().code, "project.missing-part") << path;
    parts = std::move(spoilt);
  }
}

TEST_F(Hostile, json_too_deep_or_broken_is_damage_with_its_place) {
  const std::string good = text_of(kDocument);
  for (const std::string& bad :
       {std::string(), std::string("{"), std::string("[]"), std::string("{\"version\":1}"),
        std::string("{\"version\":0}"), std::string("{\"version\":\"1\"}"), good.substr(0, good.size() / 2),
        "{\"version\":1,\"pictures\":" + std::string(200'000, '[') + std::string(200'000, ']') + "}",
        "{\"version\":1,\"pictures\":" + std::string(200'000, '[')}) {
    set_text(kDocument, bad);
    EXPECT_EQ(refusal().code, "project.damaged") << bad.substr(0, 40);
    EXPECT_NE(refusal().where.find(kDocument), std::string::npos);
  }
}

TEST_F(Hostile, every_part_of_the_document_is_needed) {
  const Json good = Json::parse(text_of(kDocument));
  for (const auto& [key, value] : good.items()) {
    Json bad = good;
    bad.erase(key);
    set_text(kDocument, bad.dump());
    EXPECT_EQ(refusal().code, "project.damaged") << key;
  }
  for (const auto& [key, value] : good["steps"].back().items()) {
    Json bad = good;
    bad["steps"].back().erase(key);
    set_text(kDocument, bad.dump());
    EXPECT_NE(refusal().code, "accepted") << key;
  }
}

TEST_F(Hostile, solves_that_fit_no_layer_are_refused) {
  const Json good = Json::parse(text_of(kDocument));
  Json bad = good;
  bad["solves"][2]["warm"] = 2;
  set_text(kDocument, bad.dump());
  EXPECT_EQ(refusal().code, "project.damaged") << "a solve that starts from itself";
  bad = good;
  bad["steps"].back()["solves"]["L1"] = 0;
  set_text(kDocument, bad.dump());
  EXPECT_EQ(refusal().code, "session.inconsistent") << "another layer's solve";
  bad = good;
  bad["steps"].back()["solves"] = Json::object();
  set_text(kDocument, bad.dump());
  EXPECT_EQ(refusal().code, "session.inconsistent");
}

TEST_F(Hostile, few_bytes_that_stand_for_many_points_are_refused) {
  Json json = Json::parse(text_of(kDocument));
  const Json step = json["steps"].back();
  for (int i = 0; i < 3000; ++i)
    json["steps"].push_back(step);
  set_text(kDocument, json.dump());
  LoadOptions little;
  little.limits.memory_bytes = 8 << 20;
  EXPECT_EQ(refusal(little).code, "project.too-large") << "the text's values";
  EXPECT_EQ(refusal().code, "accepted");

  json["steps"].back()["layers"] = std::vector<int>(100'000, 0);
  set_text(kDocument, json.dump());
  little.limits.memory_bytes = 128 << 20;
  const Error layers = refusal(little);
  EXPECT_EQ(layers.code, "project.damaged");
  EXPECT_NE(layers.sentence.find("points"), std::string::npos) << layers.sentence;
}

/// All leaves of a JSON value.
void collect_leaves(Json& json, std::vector<Json*>& leaves) {
  if (!json.is_structured() || json.empty()) return leaves.push_back(&json);
  for (auto& each : json)
    collect_leaves(each, leaves);
}

TEST_F(Hostile, whatever_value_is_spoilt_the_project_is_refused_or_works) {
  const Json good = Json::parse(text_of(kDocument));
  const std::vector<Json> values{
      nullptr,     -1,   0,   1,  2,    7,    1e308,         -1e9,           2147483647,
      0.5,         true, "x", "", "L1", "P1", Json::array(), Json::object(), Json::array({1, 2}),
      4294967296LL};
  std::mt19937 random(7);
  int accepted = 0;
  const int tries = testing::tries(250, "OVERSKETCH_SPOILT_VALUES");
  for (int i = 0; i < tries; ++i) {
    Json bad = good;
    std::vector<Json*> leaves;
    // Curves are most of the text; every other time they are left alone.
    for (auto& [key, value] : bad.items())
      if (key != "curves" || i % 2 == 0) collect_leaves(value, leaves);
    *leaves[random() % leaves.size()] = values[random() % values.size()];
    set_text(kDocument, bad.dump());
    write_parts(folder / "bad.ora", parts);
    auto loaded = load_project(folder / "bad.ora");
    if (!loaded) continue;
    ++accepted;
    Session& session = loaded->session;
    for (;;) {
      if (const auto picture = session.composite(); !picture) EXPECT_FALSE(picture.error().sentence.empty());
      if (!session.history().can_undo()) break;
      ASSERT_TRUE(session.undo().ok());
    }
  }
  EXPECT_GT(accepted, tries / 50) << "names and settings may be anything";
}

TEST_F(Hostile, whatever_byte_is_spoilt_or_missing_the_project_is_refused_or_the_same) {
  const std::string good = folder.read("good.ora");
  Session session = load(folder / "good.ora");
  std::mt19937 random(11);
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bad = good;
    if (i % 5 == 0)
      bad.resize(random() % bad.size());
    else
      bad[random() % bad.size()] ^= static_cast<char>(1 << random() % 8);
    folder.write("bad.ora", bad);
    auto loaded = load_project(folder / "bad.ora");
    if (!loaded) {
      ++refused;
      continue;
    }
    if (loaded->foreign) continue;
    EXPECT_EQ(loaded->session.document(), session.document()) << i;
  }
  EXPECT_GT(refused, 50);
}

TEST_F(Hostile, xml_with_entities_document_types_or_too_deep_is_refused) {
  const auto code = [](const std::string& xml) {
    const auto stack = parse_stack(xml, {});
    return stack.ok() ? "accepted" : stack.error().code;
  };
  const std::string layer = "<layer src=\"a.png\"/>";
  const auto image = [](const std::string& inside) {
    return "<image w=\"5\" h=\"5\"><stack>" + inside + "</stack></image>";
  };
  EXPECT_EQ(code(image(layer)), "accepted");
  EXPECT_EQ(code("<!DOCTYPE image [<!ENTITY a \"aaaaaaaaaa\">]>" + image(layer)), "project.damaged");
  EXPECT_EQ(code("<!DOCTYPE image SYSTEM \"file:///etc/passwd\">" + image(layer)), "project.damaged");
  EXPECT_EQ(parse_stack(image("<layer src=\"&a;\"/>"), {})->layers[0].source, "&a;") << "nothing is put in for it";
  std::string deep;
  for (int i = 0; i < 100'000; ++i)
    deep += "<stack>";
  EXPECT_EQ(code(image(deep)), "project.damaged") << "not closed";
  for (int i = 0; i < 100'000; ++i)
    deep += "</stack>";
  EXPECT_EQ(code(image(deep)), "project.too-large");
  for (const int depth : {31, 32}) {
    std::string open, close;
    for (int i = 0; i < depth; ++i)
      open += "<stack>", close += "</stack>";
    EXPECT_EQ(code(image(open + layer + close)), depth == 31 ? "accepted" : "project.too-large");
  }
  std::string many;
  for (int i = 0; i < 10'001; ++i)
    many += layer;
  EXPECT_EQ(code(image(many)), "project.too-large");
  EXPECT_EQ(code("<image w=\"5\" h=\"5\"><stack>" + layer), "project.damaged");
  EXPECT_EQ(code("<other/>"), "project.damaged");
  EXPECT_EQ(code(""), "project.damaged");
  for (const char* bad : {"w=\"0\" h=\"5\"", "w=\"-5\" h=\"5\"", "w=\"5\"", "w=\"1e99\" h=\"5\"", "w=\"nan\" h=\"5\""})
    EXPECT_EQ(code("<image " + std::string(bad) + "><stack/></image>"), "project.damaged") << bad;
  EXPECT_EQ(code("<image w=\"99999\" h=\"99999\"><stack/></image>"), "project.too-large");
  for (const char* bad : {"x=\"1.5\"", "y=\"99999999999\"", "opacity=\"2\"", "opacity=\"nan\"", "opacity=\"x\""})
    EXPECT_EQ(code(image("<layer src=\"a.png\" " + std::string(bad) + "/>")), "project.damaged") << bad;
  EXPECT_EQ(code(image("<layer/>")), "project.damaged");
}

} // namespace
} // namespace oversketch
