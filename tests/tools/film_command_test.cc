// `talus film` on recorded runs.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include "tests/process/process.h"

namespace talus::film_command_test {
namespace {

/// Frames of an animated WebP: its ANMF chunks.
int frames_in(const std::string& webp) {
  int frames = 0;
  for (std::size_t at = webp.find("ANMF"); at != std::string::npos; at = webp.find("ANMF", at + 4)) ++frames;
  return frames;
}

TEST(FilmCommand, MakesAnAnimatedWebpOfTheRun) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=60 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string film = "film " + (folder / "run") + " --width 320 --speed 1 --rate 10 --out ";
  ASSERT_EQ(talus_command(film + (folder / "a.webp")).exit_code, 0);
  const std::string bytes = contents(folder / "a.webp");
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 4), "WEBP");
  EXPECT_EQ(frames_in(bytes), 20) << "two seconds at ten frames a second";
  ASSERT_EQ(talus_command(film + (folder / "b.webp")).exit_code, 0);
  EXPECT_TRUE(contents(folder / "b.webp") == bytes) << "the same run gives the same film";
}

TEST(FilmCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = talus_command("film " + (folder / "run") + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("--out a.webp", "must be a folder that `talus run` left");
  refused("--out a.mp4", "--out");
  refused("--out a.webp --speed nan", "--speed");
  refused("--out a.webp --rate 500", "--rate");
  refused("--out a.webp --from 5 --to 3", "--to");
}

}  // namespace
}  // namespace talus::film_command_test

#endif
