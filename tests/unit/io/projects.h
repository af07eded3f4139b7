#pragma once

// Sessions and archives that the tests of this room use.

#include "core/base/file.h"
#include "core/image/levels.h"
#include "core/io/archive.h"
#include "core/io/project.h"

#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace oversketch::testing {

/// Each value rounded to 1/`top`: what a PNG holds.
inline Image rounded(const Image& image, float top) {
  Raster<Rgba> pixels = image.pixels();
  const auto round = [&](float& v) { v = std::round(v * top) / top; };
  for (Rgba& p : pixels.values())
    round(p.r), round(p.g), round(p.b), round(p.a);
  return Image(std::move(pixels));
}

/// A picture with all kinds of alpha, whole areas of 0 and 1 among them.
inline Image translucent_image(int width, int height) {
  Raster<Rgba> pixels = wavy_image(width, height, 0.4).pixels();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels.at(x, y).a = std::clamp(static_cast<float>(0.5 + 0.9 * std::sin(0.11 * x - 0.07 * y)), 0.0f, 1.0f);
  return rounded(Image(std::move(pixels)), 255);
}

inline void must_run(Session& session, const Command& command) {
  const auto done = session.execute(command);
  ASSERT_TRUE(done.ok()) << to_string(done.error());
}

inline Session begun_with(Image target) {
  Session session;
  DocumentNew begin;
  begin.target = loaded_ref("some/folder/target.png", std::move(target));
  must_run(session, begin);
  return session;
}

/// A session in which a person did all sorts of things, undo and redo among them.
inline Session random_session(unsigned seed, int steps, Image target) {
  RandomCommands random(seed);
  Session session = begun_with(std::move(target));
  for (int i = 0; i < steps; ++i) {
    if (random.below(9) == 0)
      (void)session.undo(static_cast<std::size_t>(random.below(3))).ok();
    else if (random.below(12) == 0)
      (void)session.redo().ok();
    else
      (void)session.execute(random.next()).ok();
  }
  return session;
}

/// One layer, deformed and blended, then redrawn twice so that solves hang together.
inline Session small_session(Image target = rounded(wavy_image(120, 90, 0), 255)) {
  Session session = begun_with(std::move(target));
  must_run(session, LayerAdd{loaded_ref("fish.png", rounded(wavy_image(100, 90, 2), 255)), std::nullopt});
  must_run(session, RegionSet{{}, blob({50, 45}, 30)});
  must_run(session, SketchSet{{}, blob({60, 42}, 27, 0.3, 60, 0.5)});
  must_run(session, PinAdd{{}, {80, 45}, {87, 42}});
  LayerSet set;
  set.stiffness = 0.4;
  must_run(session, set);
  return session;
}

inline Image picture_of(Session& session) {
  const auto picture = session.composite();
  EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : to_string(picture.error()));
  return picture.ok() ? *picture : Image();
}

inline void save(Session& session, const std::filesystem::path& path, const SaveOptions& options = {}) {
  const auto saved = save_project(session, path, options);
  ASSERT_TRUE(saved.ok()) << to_string(saved.error());
}

inline Session load(const std::filesystem::path& path) {
  auto loaded = load_project(path);
  EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : to_string(loaded.error()));
  return loaded.ok() ? std::move(loaded->session) : Session();
}

inline std::vector<std::byte> bytes_of_text(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

/// The parts of an archive, to be changed and put together again.
inline std::vector<ArchivePart> parts_of(const std::filesystem::path& path, const std::vector<std::string>& names) {
  std::vector<ArchivePart> parts;
  const auto archive = Archive::open(path, {});
  EXPECT_TRUE(archive.ok());
  if (!archive) return parts;
  for (const std::string& name : names) {
    auto bytes = archive->read(name, 100 << 20);
    EXPECT_TRUE(bytes.ok()) << name;
    if (bytes) parts.push_back({name, std::move(*bytes), true});
  }
  return parts;
}

inline void write_parts(const std::filesystem::path& path, std::vector<ArchivePart> parts) {
  const auto bytes = make_archive(std::move(parts));
  ASSERT_TRUE(bytes.ok());
  ASSERT_TRUE(write_file(path, std::span<const std::byte>(*bytes)).ok());
}

} // namespace oversketch::testing
