// The pictures beside a journal's lines.

#include "core/base/file.h"
#include "core/image/image_io.h"

#include "tests/unit/io/journal_fixture.h"

#include <map>

namespace oversketch {
namespace {

using namespace testing;
namespace fs = std::filesystem;

TEST_F(JournalTest, keeps_a_picture_as_the_file_it_was_read_from) {
  const fs::path file = folder / "sea.jpg";
  ASSERT_TRUE(save_image(wavy_image(70, 50, 1), file).ok());
  const std::string bytes = folder.read("sea.jpg");
  Session session;
  ASSERT_TRUE(session.execute(DocumentNew{ImageRef{file.string(), *load_image(file)}, {}, {}, {}}).ok());
  // Made here, so that it has no file; and the same pixels as the target's from a file of another kind.
  ASSERT_TRUE(session.execute(LayerAdd{loaded_ref("made.jpg", wavy_image(40, 30, 2)), {}}).ok());
  auto packed = encode_png(session.document().target.image);
  ASSERT_TRUE(packed.ok());
  ASSERT_TRUE(session.execute(LayerAdd{loaded_ref("again", *decode_file(std::move(*packed))), {}}).ok());
  // What becomes of the file afterwards is nobody's concern.
  folder.write("sea.jpg", "something else");
  const fs::path left = leave_journal(session);
  std::map<std::string, std::string> kept;
  for (const auto& entry : fs::recursive_directory_iterator(left / "images"))
    if (entry.is_regular_file())
      kept[entry.path().filename().string()] = folder.read(fs::relative(entry.path(), folder.path()).string());
  EXPECT_EQ(kept.size(), 2U) << "each content once";
  EXPECT_EQ(kept["sea.jpg"], bytes);
  EXPECT_EQ(kept["made.jpg"].substr(0, 8), "OSFLOAT1") << "packed: no PNG holds it";
  RecoveredJournal recovered = recover(left);
  EXPECT_EQ(recovered.message, "");
  expect_same(recovered.session, session);
  // It goes on with its own files.
  const Image& target = recovered.session.document().target.image;
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(target.file().data()), target.file().size()), bytes);
}

TEST_F(JournalTest, a_picture_that_was_damaged_is_told_and_written_again_when_it_comes_again) {
  const Image sea = *decode_file(*encode_png(wavy_image(70, 50, 1))),
              fish = *decode_file(*encode_png(wavy_image(40, 30, 2)));
  Session session;
  ASSERT_TRUE(session.execute(DocumentNew{ImageRef{"sea.png", sea}, {}, {}, {}}).ok());
  ASSERT_TRUE(session.execute(LayerAdd{ImageRef{"fish.png", fish}, {}}).ok());
  const fs::path left = leave_journal(session);
  const fs::path file = left / "images" / to_string(fish.content_hash()) / "fish.png";
  const std::string whole = *read_text_file(file);
  ASSERT_TRUE(write_file(file, std::string_view(whole).substr(0, whole.size() / 2)).ok());
  {
    RecoveredJournal recovered = recover(left);
    EXPECT_NE(recovered.message.find("fish.png"), std::string::npos) << recovered.message;
    EXPECT_NE(recovered.message.find("journal.jsonl~"), std::string::npos) << recovered.message;
    EXPECT_EQ(recovered.steps, 1);
    append_from(recovered.journal, session, 1);
  }
  EXPECT_EQ(*read_text_file(file), whole);
  RecoveredJournal again = recover(left);
  EXPECT_EQ(again.message, "");
  expect_same(again.session, session);
}

TEST_F(JournalTest, another_picture_in_the_place_of_one_is_told) {
  Session session = small_session();
  const fs::path left = leave_journal(session);
  for (const auto& entry : fs::recursive_directory_iterator(left / "images"))
    if (entry.path().filename() == "fish.png") {
      ASSERT_TRUE(write_file(entry.path(), *encode_png(session.document().layers[0].source.image)).ok());
      EXPECT_EQ(recover(left).message, "") << "the same picture, packed in another way";
      ASSERT_TRUE(write_file(entry.path(), *encode_png(wavy_image(100, 90, 3))).ok());
    }
  const RecoveredJournal recovered = recover(left);
  EXPECT_NE(recovered.message.find("fish.png is another picture"), std::string::npos) << recovered.message;
  EXPECT_EQ(recovered.steps, static_cast<int>(session.log().size()));
}

TEST_F(JournalTest, keeps_pictures_of_any_name) {
  Session session;
  ASSERT_TRUE(
      session.execute(DocumentNew{loaded_ref(std::string(100, '\xe9') + ".png", wavy_image(30, 20, 1)), {}, {}, {}})
          .ok());
  std::string umlauts;
  for (int i = 0; i < 127; ++i)
    umlauts += "ü";
  int seed = 2;
  for (const std::string& name :
       {umlauts, umlauts + ".jpeg", std::string(250, 'a') + ".png", "a." + std::string(240, 'b')})
    ASSERT_TRUE(session.execute(LayerAdd{loaded_ref(name, wavy_image(30, 20, seed++)), "layer"}).ok());
  const fs::path left = leave_journal(session);
  RecoveredJournal recovered = recover(left);
  EXPECT_EQ(recovered.message, "");
  expect_same(recovered.session, session);
}

} // namespace
} // namespace oversketch
