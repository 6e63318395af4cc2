// `talus film` on recorded runs.

#ifdef TALUS_LCM

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

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

TEST(FilmCommand, MakesSmallerWebpWithLoss) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=60 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string film = "film " + (folder / "run") + " --width 320 --speed 1 --rate 10 --out ";
  ASSERT_EQ(talus_command(film + (folder / "all.webp")).exit_code, 0);
  ASSERT_EQ(talus_command(film + (folder / "less.webp") + " --quality 20").exit_code, 0);
  EXPECT_LT(contents(folder / "less.webp").size(), contents(folder / "all.webp").size());
}

TEST(FilmCommand, MakesMp4AndGifThatFfprobeReads) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=60 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string ending : {"mp4", "gif"}) {
    const std::string file = folder / ("a." + ending);
    const Outcome film = talus_command("film " + (folder / "run") + " --width 321 --speed 1 --rate 10 --out " + file);
    ASSERT_EQ(film.exit_code, 0) << film.err;
    const std::string read =
        shell("ffprobe -v error -count_frames -show_entries stream=codec_name,width,nb_read_frames -of csv=p=0 " + file)
            .out;
    // Twenty frames; an MP4 has the last one for a second and a half, and an even width.
    EXPECT_EQ(read, ending == "mp4" ? "h264,322,35\n" : "gif,321,20\n");
  }
}

TEST(FilmCommand, DrawsForceChainsOfARunThatTellsContactsWhichIsTheSameRun) {
  const TemporaryFolder folder;
  std::vector<std::string> films;
  std::vector<std::string> hashes;
  for (const std::string contacts : {"false", "true"}) {
    const std::string run = folder / contacts;
    const Outcome outcome = talus_command("run drop_in_a_pile_2d --no-telemetry --hash --set run.frames=60 --out " +
                                          run + " --set run.contacts=" + contacts);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    hashes.push_back(outcome.out);
    EXPECT_EQ(talus_command("info " + run).out.find("TALUS_CONTACTS") != std::string::npos, contacts == "true");
    const Outcome film = talus_command("film " + run + " --width 320 --from 1.5 --out " + run + ".webp");
    ASSERT_EQ(film.exit_code, 0) << film.err;
    films.push_back(contents(run + ".webp"));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(films[0], films[1]);
}

TEST(FilmCommand, NamesTheProgramThatIsMissing) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=10 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Outcome film =
      shell("PATH=/nowhere \"$TALUS\" film " + (folder / "run") + " --width 320 --out " + (folder / "a.mp4"));
  EXPECT_EQ(film.exit_code, 1);
  EXPECT_NE(film.err.find("needs the program ffmpeg (Debian package ffmpeg)"), std::string::npos) << film.err;
}

TEST(FilmCommand, NamesAFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=10 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::filesystem::create_symlink("/no/such/folder", folder.path() / "a.mp4");
  const Outcome film = talus_command("film " + (folder / "run") + " --width 320 --out " + (folder / "a.mp4"));
  EXPECT_EQ(film.exit_code, 1);
  EXPECT_NE(film.err.find("a.mp4"), std::string::npos) << film.err;
}

TEST(FilmCommand, ThatFailsLeavesAnOlderFilmAsItIs) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=10 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ofstream(folder / "a.webp") << "older";
  const Outcome film =
      shell("ulimit -f 1; \"$TALUS\" film " + (folder / "run") + " --width 320 --out " + (folder / "a.webp"));
  EXPECT_EQ(film.exit_code, 1) << film.err;
  EXPECT_EQ(contents(folder / "a.webp"), "older");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "the run and the film";
}

TEST(FilmCommand, FailsOnAFullDisk) {
  const TemporaryFolder folder;
  const Outcome run =
      talus_command("run drop_in_a_pile_2d --no-telemetry --set run.frames=10 --out " + (folder / "run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string file : {"a.gif", "a.webp"}) {
    std::filesystem::create_symlink("/dev/full", folder.path() / file);
    EXPECT_EQ(talus_command("film " + (folder / "run") + " --width 320 --out " + (folder / file)).exit_code, 1) << file;
  }
}

TEST(FilmCommand, RefusesBadOptions) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& arguments, const std::string& said) {
    const Outcome outcome = talus_command("film " + (folder / "run") + " " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused("--out a.webp", "must be a folder that `talus run` left");
  refused("--out a.avi", "must end in .webp, .mp4 or .gif");
  refused("--out a.webp --quality 101", "--quality");
  refused("--out a.gif --quality 50", "--quality");
  refused("--out a.webp --speed nan", "--speed");
  refused("--out a.webp --rate 500", "--rate");
  refused("--out a.webp --from 5 --to 3", "--to");
}

}  // namespace
}  // namespace talus::film_command_test

#endif
