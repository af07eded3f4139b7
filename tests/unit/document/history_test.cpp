#include "core/document/history.h"

#include "tests/support/documents.h"

#include <gtest/gtest.h>

namespace oversketch {
namespace {

using namespace testing;

TEST(History, refuses_steps_that_are_not_there) {
  History history;
  EXPECT_EQ(history.undo().error().code, "history.nothing-to-undo");
  EXPECT_EQ(history.redo().error().code, "history.nothing-to-redo");
  EXPECT_EQ(history.jump(0).error().code, "history.index");
  EXPECT_TRUE(history.present().empty());
  EXPECT_FALSE(history.modified());
  EXPECT_EQ(history.execute(LayerMove{}).error().code, "document.none");
  EXPECT_TRUE(history.entries().empty());
}

TEST(History, undo_all_and_redo_all_give_equal_documents_on_random_commands) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    RandomCommands random(seed);
    History history;
    ASSERT_TRUE(history.execute(new_document(120, 100)).ok());
    std::vector<Document> seen{history.present()};
    while (seen.size() < 60) {
      const Document before = history.present();
      const auto done = history.execute(random.next());
      if (!done) {
        ASSERT_EQ(history.present(), before) << "seed " << seed;
        continue;
      }
      seen.push_back(history.present());
    }
    for (std::size_t i = seen.size() - 1; i-- > 0;) {
      ASSERT_TRUE(history.undo().ok());
      ASSERT_EQ(history.present(), seen[i]) << "seed " << seed << " step " << i;
    }
    EXPECT_FALSE(history.can_undo());
    for (std::size_t i = 1; i < seen.size(); ++i) {
      ASSERT_TRUE(history.redo().ok());
      ASSERT_EQ(history.present(), seen[i]) << "seed " << seed << " step " << i;
    }
    EXPECT_FALSE(history.can_redo());
    ASSERT_TRUE(history.jump(17).ok());
    EXPECT_EQ(history.present(), seen[17]);
  }
}

TEST(History, replaying_its_commands_gives_the_same_documents) {
  for (unsigned seed = 100; seed < 120; ++seed) {
    RandomCommands random(seed);
    History history, replay;
    ASSERT_TRUE(history.execute(new_document(120, 100)).ok());
    for (int i = 0; i < 100; ++i)
      (void)history.execute(random.next()).ok();
    for (const History::Entry& entry : history.entries()) {
      ASSERT_TRUE(replay.execute(entry.command).ok());
      EXPECT_EQ(replay.present(), entry.document);
    }
  }
}

TEST(History, a_new_command_drops_what_was_undone) {
  History history;
  ASSERT_TRUE(history.execute(new_document(50, 50)).ok());
  ASSERT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  ASSERT_TRUE(history.execute(LayerRename{{}, "b"}).ok());
  ASSERT_TRUE(history.undo().ok());
  ASSERT_TRUE(history.execute(LayerRename{{}, "c"}).ok());
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.entries().size(), 3u);
  EXPECT_EQ(history.entries()[2].label, "Rename layer to c");
}

TEST(History, a_new_document_begins_a_new_history) {
  History history;
  ASSERT_TRUE(history.execute(new_document(50, 50)).ok());
  ASSERT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  ASSERT_TRUE(history.execute(new_document(60, 60)).ok());
  EXPECT_FALSE(history.can_undo());
  EXPECT_EQ(history.entries().size(), 1u);
  EXPECT_FALSE(history.modified());
}

TEST(History, modified_means_not_where_it_was_saved) {
  History history;
  ASSERT_TRUE(history.execute(new_document(50, 50)).ok());
  EXPECT_FALSE(history.modified());
  ASSERT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  EXPECT_TRUE(history.modified());
  history.mark_saved();
  EXPECT_FALSE(history.modified());
  ASSERT_TRUE(history.undo().ok());
  EXPECT_TRUE(history.modified());
  ASSERT_TRUE(history.redo().ok());
  EXPECT_FALSE(history.modified());
  ASSERT_TRUE(history.undo().ok());
  ASSERT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "b"}).ok());
  ASSERT_TRUE(history.undo().ok());
  ASSERT_TRUE(history.redo().ok());
  EXPECT_TRUE(history.modified()) << "the saved state was dropped";
}

TEST(History, keeps_at_least_fifty_steps_and_drops_images_beyond_its_budget) {
  History history(History::Limits{50, 1 << 20, 1000});
  ASSERT_TRUE(history.execute(new_document(50, 50)).ok());
  // Each target is a picture of its own of 160 kB: far more than fifty of them fit nowhere in a megabyte.
  for (int i = 0; i < 200; ++i)
    ASSERT_TRUE(history.execute(TargetSet{loaded_ref("t" + std::to_string(i), plain_image(100, 100))}).ok());
  EXPECT_EQ(history.cursor(), 50u);
  EXPECT_EQ(history.present().target.name, "t199");
  ASSERT_TRUE(history.undo(50).ok());
  EXPECT_EQ(history.present().target.name, "t149");

  History light(History::Limits{50, 1 << 20, 1000});
  ASSERT_TRUE(light.execute(new_document(50, 50)).ok());
  ASSERT_TRUE(light.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  for (int i = 0; i < 300; ++i)
    ASSERT_TRUE(light.execute(LayerMove{{}, {1, 0}}).ok());
  EXPECT_EQ(light.cursor(), 301u);
}

/// A part with curves of 32 kB, moved 300 times.
History moved_often(std::size_t bytes) {
  History history(History::Limits{50, bytes, 1000});
  EXPECT_TRUE(history.execute(new_document(300, 300)).ok());
  EXPECT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  EXPECT_TRUE(history.execute(RegionSet{{}, blob({150, 150}, 90, 0, 1000)}).ok());
  for (int i = 0; i < 300; ++i)
    EXPECT_TRUE(history.execute(LayerMove{{}, {1, 0}}).ok());
  return history;
}

TEST(History, drops_curves_beyond_its_budget) {
  // A megabyte is full after 32 steps.
  History history = moved_often(1 << 20);
  EXPECT_EQ(history.cursor(), 50U);
  ASSERT_TRUE(history.undo(50).ok());
  EXPECT_EQ(history.present().layers[0].placement.dx, 250);

  const History roomy = moved_often(4 << 20);
  EXPECT_GT(roomy.cursor(), 90U);
  EXPECT_LT(roomy.cursor(), 140U);
}

TEST(Gesture, is_one_step_or_none) {
  History history;
  ASSERT_TRUE(history.execute(new_document(50, 50)).ok());
  ASSERT_TRUE(history.execute(LayerAdd{{std::string(kTargetName), {}}, "a"}).ok());
  const Document before = history.present();
  {
    Gesture gesture(history);
    for (int i = 1; i <= 20; ++i)
      ASSERT_TRUE(gesture.preview(LayerMove{{}, {i, 0}}).ok());
    EXPECT_EQ(gesture.pending().layers[0].placement.dx, 20) << "each preview starts from the gesture's base";
    EXPECT_EQ(history.present(), before);
  }
  EXPECT_EQ(history.cursor(), 1u) << "leaving the scope cancels";
  Gesture gesture(history);
  ASSERT_TRUE(gesture.preview(LayerMove{{}, {5, 0}}).ok());
  EXPECT_FALSE(gesture.preview(LayerMove{LayerId{9}, {6, 0}}).ok());
  ASSERT_TRUE(gesture.preview(LayerMove{{}, {7, 0}}).ok());
  gesture.commit();
  EXPECT_EQ(history.cursor(), 2u);
  EXPECT_EQ(history.entries()[2].label, "Move 7, 0");
  gesture.commit();
  EXPECT_EQ(history.cursor(), 2u) << "a second commit has nothing to push";
}

} // namespace
} // namespace oversketch
