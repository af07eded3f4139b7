#pragma once

#include "core/io/journal.h"

#include "tests/unit/io/projects.h"

namespace oversketch::testing {

class JournalTest : public ::testing::Test {
protected:
  Journal begin(const std::filesystem::path& base = {}) {
    auto journal = Journal::begin(folder.path(), "work.ora", base);
    EXPECT_TRUE(journal.ok()) << (journal.ok() ? "" : to_string(journal.error()));
    return std::move(*journal);
  }
  /// Everything that the session logged from there on.
  static void append_from(Journal& journal, const Session& session, std::size_t first) {
    for (std::size_t i = first; i < session.log().size(); ++i) {
      const auto done = journal.append(session.log()[i]);
      ASSERT_TRUE(done.ok()) << to_string(done.error());
    }
  }
  /// A journal of all that the session logged, whose process is gone.
  std::filesystem::path leave_journal(const Session& session) {
    Journal journal = begin();
    append_from(journal, session, 0);
    return journal.folder();
  }
  RecoveredJournal recover(const std::filesystem::path& journal) {
    auto recovered = recover_journal(journal);
    EXPECT_TRUE(recovered.ok()) << (recovered.ok() ? "" : to_string(recovered.error()));
    return std::move(*recovered);
  }
  static void expect_same(Session& again, Session& session) {
    EXPECT_EQ(again.document(), session.document());
    EXPECT_EQ(again.history().cursor(), session.history().cursor());
    EXPECT_EQ(again.history().entries().size(), session.history().entries().size());
    EXPECT_EQ(picture_of(again), picture_of(session));
  }
  std::string text(const std::filesystem::path& journal) const {
    return folder.read(std::filesystem::relative(journal / "journal.jsonl", folder.path()).string());
  }
  void set_text(const std::filesystem::path& journal, const std::string& text) const {
    folder.write(std::filesystem::relative(journal / "journal.jsonl", folder.path()).string(), text);
  }

  TempFolder folder;
};

} // namespace oversketch::testing
