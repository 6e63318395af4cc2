// Command lines that cannot be obeyed: each ends with exit code 2 and a message with option, value and rule, prints no
// result and leaves no file.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <vector>

#include "tests/process/process.h"

namespace talus::bad_command_lines_test {
namespace {

namespace fs = std::filesystem;

struct BadLine {
  std::string arguments;
  std::vector<std::string> told;  // in the message
};

/// A folder with what good command lines need: `flat` and `solid`, recorded runs; files that are nothing of the kind.
class BadCommandLine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const std::string run = R"("$TALUS" run drop_in_a_pile_$dimension --no-telemetry --set run.frames=5 --out $name)";
    const std::string script = "dimension=2d name=flat; " + run +
#ifdef TALUS_BULLET
                               "; dimension=3d name=solid; " + run +
#endif
                               R"(
mkdir full empty folder.csv folder.html folder.pvd folder.webp; echo text >full/file; echo text >text; : >nothing.toml; echo 'title = 3' >wrong.toml
{ printf 'title = "comb"\ndimension = 2\nshape.tooth = {kind = "polygon", corners = [[0, 0], [1, 0], [2, 1], [2, 2], [1, 3], [0, 3], [-1, 2], [-1, 1]]}\nshape.comb = {kind = "compound", parts = ['
for i in $(seq 4 4 1840); do printf '{shape = "tooth", position = [%s, 0]},' "$i"; done
printf ']}\n[[body]]\nshape = "comb"\nposition = [0, 1]\n'; } >comb.toml
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >open.obj; printf 'v 0 0 nan\n' >nan.obj
)";
    ASSERT_EQ(shell(in_folder(script)).exit_code, 0);
    before_ = entries();
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string in_folder(const std::string& script) { return "cd " + folder_->path().string() + "\n" + script; }

  static std::set<std::string> entries() {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_->path())) names.insert(entry.path().string());
    return names;
  }

  static void refuse(const std::vector<BadLine>& lines) {
    for (const BadLine& line : lines) {
      const Outcome outcome = shell(in_folder("timeout 20 \"$TALUS\" " + line.arguments));
      EXPECT_EQ(outcome.exit_code, 2) << line.arguments << "\n" << outcome.err;
      EXPECT_EQ(outcome.out, "") << line.arguments;
      for (const std::string& word : line.told) {
        EXPECT_NE(outcome.err.find(word), std::string::npos) << line.arguments << ": no " << word << " in\n"
                                                             << outcome.err;
      }
      for (const std::string& entry : entries()) {
        if (before_.contains(entry)) continue;
        ADD_FAILURE() << line.arguments << ": leaves " << entry;
        fs::remove_all(entry);
      }
    }
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::set<std::string> before_;
};

TEST_F(BadCommandLine, OfTheCommandItselfIsRefused) {
  refuse({{"", {"subcommand"}},
          {"walk", {"walk"}},
          {"--nonsense", {"--nonsense"}},
          {"run list", {"list"}},
          {"list everything", {"everything"}},
          {"list --json", {"--json"}},
          {"'run '", {"run "}}});
}

TEST_F(BadCommandLine, OfReferenceIsRefused) {
  refuse({{"reference --update no_such.md", {"--update = no_such.md: must be a regular file that can be read"}},
          {"reference --update full", {"--update = full: must be a regular file that can be read"}},
          {"reference --update text", {"--update = text: must have a mark"}},
          {"reference --update nothing.toml", {"--update = nothing.toml: must have a mark"}}});
}

TEST_F(BadCommandLine, OfRunWithoutASceneIsRefused) {
  refuse({{"run", {"scene"}},
          {"run ''", {"scene"}},
          {"run no_such_scene", {"no_such_scene", "must be"}},
          {"run drop_in_a_pile_2", {"drop_in_a_pile_2d"}},
          {"run no/such.toml", {"no/such.toml"}},
          {"run full", {"full"}},
          {"run nothing.toml", {"nothing.toml"}},
          {"run wrong.toml", {"wrong.toml:1", "title"}},
          {"run text", {"text:1"}},
          {"run drop_in_a_pile_2d another", {"another"}},
          {"run drop_in_a_pile_2d --sed 3", {"--sed"}}});
}

TEST_F(BadCommandLine, OfRunWithABadBackendOrPolicyIsRefused) {
  refuse({{"run drop_in_a_pile_2d --backend", {"--backend"}},
          {"run drop_in_a_pile_2d --backend ''", {"--backend"}},
          {"run drop_in_a_pile_2d --backend havok", {"--backend", "havok", "box2d"}},
          {"run drop_in_a_pile_2d --backend bullet", {"--backend", "bullet", "box2d"}},
          {"run drop_in_a_pile_2d --backend BOX2D", {"--backend", "BOX2D", "box2d"}},
          {"run drop_in_a_pile_2d --policy", {"--policy"}},
          {"run drop_in_a_pile_2d --policy ''", {"--policy"}},
          {"run drop_in_a_pile_2d --policy lazy", {"--policy", "lazy", "adaptive"}},
          {"run drop_in_a_pile_2d -p full -p paper", {"--policy"}},
          {"run drop_in_a_pile_2d --against lazy", {"--against", "lazy", "adaptive"}},
          {"run drop_in_a_pile_2d --against ''", {"--against"}},
          {"run drop_in_a_pile_2d --against full --hash", {"--against excludes --hash"}}});
}

TEST_F(BadCommandLine, OfRunWithABadSettingOrSeedIsRefused) {
  refuse({{"run drop_in_a_pile_2d --set", {"--set"}},
          {"run drop_in_a_pile_2d --set ''", {"--set", "path=value"}},
          {"run drop_in_a_pile_2d --set run.frames", {"--set run.frames", "path=value"}},
          {"run drop_in_a_pile_2d --set =3", {"--set =3", "path=value"}},
          {"run drop_in_a_pile_2d --set run.frames=-1", {"--set run.frames=-1", "must be"}},
          {"run drop_in_a_pile_2d --set run.frames=many", {"--set run.frames=many", "must be"}},
          {"run drop_in_a_pile_2d --set run.frame_rate=nan", {"--set run.frame_rate=nan", "must be"}},
          {"run drop_in_a_pile_2d --set run.frame_rate=1e-45", {"--set run.frame_rate=1e-45", "must"}},
          {"run drop_in_a_pile_2d --set walk.speed=3", {"--set walk.speed=3", "no such key"}},
          {"run drop_in_a_pile_2d --set policy.tua=0.3", {"tau"}},
          {"run drop_in_a_pile_2d --set 'source[9].rate=3'", {"--set source[9].rate=3", "only"}},
          {"run drop_in_a_pile_2d --set 'source[0.count=7'", {"--set source[0.count=7", "path=value"}},
          {"run drop_in_a_pile_2d --set source.rate=3", {"--set source.rate=3", "source[0].rate"}},
          {"run drop_in_a_pile_2d --set pile[0].growth_ratio=1e-45", {"growth_ratio=1e-45", "must be"}},
          {"run drop_in_a_pile_2d --seed", {"--seed"}},
          {"run drop_in_a_pile_2d --seed -1", {"--seed", "-1"}},
          {"run drop_in_a_pile_2d --seed 1.5", {"--seed", "1.5"}},
          {"run drop_in_a_pile_2d --seed 99999999999999999999", {"--seed", "99999999999999999999"}}});
}

TEST_F(BadCommandLine, OfRunWithABadFolderOrAddressIsRefused) {
  refuse({{"run drop_in_a_pile_2d --out", {"--out"}},
          {"run drop_in_a_pile_2d --out ''", {"--out"}},
          {"run drop_in_a_pile_2d --out full", {"--out = full", "must be a new or empty folder"}},
          {"run drop_in_a_pile_2d --out text", {"--out = text", "must be a new or empty folder"}},
          {"run drop_in_a_pile_2d --out text/below", {"--out = text/below", "Not a directory"}},
          {"run drop_in_a_pile_2d --out /proc/below", {"--out = /proc/below"}},
          {"run drop_in_a_pile_2d --telemetry-hz -1", {"--telemetry-hz", "-1", "must be"}},
          {"run drop_in_a_pile_2d --telemetry-hz nan", {"--telemetry-hz", "nan", "must be"}},
          {"run drop_in_a_pile_2d --telemetry-hz often", {"--telemetry-hz", "often", "must be"}},
#ifdef TALUS_LCM
          {"run drop_in_a_pile_2d --lcm-url ''", {"--lcm-url"}},
          {"run drop_in_a_pile_2d --lcm-url nonsense --out new", {"--lcm-url", "nonsense", "must begin with"}},
          {"run drop_in_a_pile_2d --lcm-url udpm://nowhere --out new",
           {"--lcm-url", "udpm://nowhere", "must name a group"}},
          {"run drop_in_a_pile_2d --lcm-url 'udpm://239.255.76.67:7667?ttl=1' --out new", {"ttl=1", "must have ttl=0"}},
          {"run drop_in_a_pile_2d --lcm-url udpm://10.0.0.1 --out new", {"--lcm-url", "10.0.0.1", "must name a group"}},
          {"run drop_in_a_pile_2d --lcm-url udpm://239.255.76.67:99999 --out new", {"--lcm-url", "must name a port"}},
          {"run drop_in_a_pile_2d --lcm-url 'udpm://239.255.76.67:7667?ttl=0' --no-telemetry",
           {"--lcm-url", "--no-telemetry"}},
#endif
          {"run drop_in_a_pile_2d --strict=maybe", {"--strict", "maybe"}}});
}

TEST_F(BadCommandLine, OfCheckIsRefused) {
  refuse({{"check", {"scene"}},
          {"check ''", {"scene"}},
          {"check no_such_scene", {"no_such_scene", "must be"}},
          {"check full", {"full"}},
          {"check wrong.toml", {"wrong.toml:1", "title"}},
          {"check nothing.toml", {"nothing.toml"}},
          {"check drop_in_a_pile_2d --set run.frames=-1", {"--set run.frames=-1", "must be"}},
          {"check drop_in_a_pile_2d --set", {"--set"}},
#ifdef TALUS_LCM
          {"check comb.toml --force", {"comb.toml: shape \"comb\"", "460 pieces", "one telemetry message"}},
#endif
          {"check drop_in_a_pile_2d --backend havok", {"--backend", "havok", "box2d"}},
          {"check drop_in_a_pile_2d --policy never", {"--policy", "never"}},
          {"check drop_in_a_pile_2d --seed -1", {"--seed", "-1"}}});
}

TEST_F(BadCommandLine, OfBenchIsRefused) {
  refuse({{"bench", {"bench", "--preset"}},
          {"bench --preset table9", {"--preset", "table9"}},
          {"bench flat --seeds 0", {"--seeds", "0", "1000"}},
          {"bench flat --seeds some", {"--seeds", "some"}},
          {"bench flat --jobs 0", {"--jobs", "0"}},
          {"bench --preset table1 --policy lazy --out new", {"--policy", "lazy"}},
          {"bench --preset table1 --policy '' --out new", {"--policy"}},
          {"bench --preset table1 --policy full, --out new", {"--policy"}},
          {"bench --preset table1 --policy full --policy paper,lazy --out new", {"--policy", "lazy"}},
          {"bench --preset table1 --policy full,full --out new", {"--policy full,full: must have no value twice"}},
          {"bench flat -p full -p paper,full --out new", {"--policy full,paper,full: must have no value twice"}},
          {"bench flat --backend box2d,box2d --out new", {"--backend box2d,box2d: must have no value twice"}},
          {"bench --preset table1 --backend box2d, --out new", {"--backend"}},
          {"bench --preset table1 --backend havok --out new", {"--backend", "havok"}},
          {"bench no_such_scene --out new", {"no_such_scene"}},
          {"bench drop_in_a_pile_2d --set run.frames=-1 --out new", {"run.frames=-1", "must be"}},
          {"bench drop_in_a_pile_2d --set seed=1,2 --out new", {"--set seed", "--seeds"}},
          {"bench drop_in_a_pile_2d --set policy.kind=full --out new", {"--set policy.kind", "--policy"}},
          {"bench drop_in_a_pile_2d --set run.frames=2 --set run.frames=3 --out new", {"run.frames", "once"}},
          {"bench drop_in_a_pile_2d --set run.frames=2 --set 'run={frames=3}' --out new", {"--set run:", "run.frames"}},
          {"bench drop_in_a_pile_2d --set run.frames=5,5 --out new", {"run.frames=5,5", "no value twice"}},
          {"bench drop_in_a_pile_2d --set 'policy={tau=0.3}' --out new", {"--set policy:", "--policy"}},
          {"bench drop_in_a_pile_2d --out ''", {"--out"}},
          {"bench drop_in_a_pile_2d --out text", {"--out", "text"}}});
}

TEST_F(BadCommandLine, OfSweepIsRefused) {
  refuse(
      {{"sweep drop_in_a_pile_2d --set run.frames=2 --set run.frames=3 --out new", {"--set run.frames", "once"}},
       {"sweep drop_in_a_pile_2d --set ground.friction=0.5,0.7,0.50 --out new", {"0.5,0.7,0.50", "no value twice"}},
       {"sweep drop_in_a_pile_2d --set policy.kind=full,full --out new", {"policy.kind=full,full", "no value twice"}},
       {"sweep drop_in_a_pile_2d --set run.frames=2,3 --set 'run={frames=4}' --out new", {"--set run:", "run.frames"}},
       {"sweep drop_in_a_pile_2d --set 'run={frames=4}' --set run.frames=2,3 --out new",
        {"--set run.frames:", "run is"}},
       {"sweep drop_in_a_pile_2d --set 'policy={tau=0.3}' --policy full --out new",
        {"--set policy.kind:", "policy is"}}});
}

#ifdef TALUS_BULLET
TEST_F(BadCommandLine, OfBenchOnBulletIsRefused) {
  refuse({{"bench drop_in_a_pile_2d --backend bullet --out new", {"--backend = bullet", "one of the scenes"}},
          {"bench drop_in_a_pile_2d --backend bullet-planar --set world.solver.kind=engine "
           "--set world.solver.velocity_iterations=2 --out new",
           {"velocity_iterations", "window"}}});
}
#endif

#ifdef TALUS_LCM

TEST_F(BadCommandLine, OfCompareIsRefused) {
  refuse({{"compare", {"run_a"}},
          {"compare flat", {"run_b"}},
          {"compare flat ''", {"run_b"}},
          {"compare flat no_run", {"no_run", "must be a folder that `talus run` left"}},
          {"compare flat empty", {"empty", "must be a folder that `talus run` left"}},
          {"compare flat text", {"text", "must be a folder that `talus run` left"}},
          {"compare flat flat flat", {"flat"}},
#ifdef TALUS_BULLET
          {"compare flat solid", {"2D", "3D"}},
#endif
          {"compare flat flat --json=maybe", {"--json", "maybe"}}});
}

TEST_F(BadCommandLine, OfFilmIsRefused) {
  refuse({{"film", {"run"}},
          {"film flat", {"--out"}},
          {"film flat --out ''", {"--out"}},
          {"film no_run --out new.webp", {"no_run", "must be a folder that `talus run` left"}},
          {"film flat --out no/folder/new.webp", {"--out", "no/folder/new.webp"}},
          {"film flat --out folder.webp", {"--out: folder.webp: must be a file, not a folder"}},
          {"film flat --out new.webp --from -1", {"--from", "-1", "must"}},
          {"film flat --out new.webp --from 1e9", {"--from", "1000000000", "must"}},
          {"film flat --out new.webp --from nan", {"--from", "nan", "must"}},
          {"film flat --out new.webp --from 0.1 --to 0.05", {"--from", "must"}},
          {"film flat --out new.webp --to nan", {"--to", "nan", "must"}},
          {"film flat --out new.webp --speed 0", {"--speed", "0", "must be"}},
          {"film flat --out new.webp --speed nan", {"--speed", "nan", "must be"}},
          {"film flat --out new.webp --rate 51", {"--rate", "51", "must be"}},
          {"film flat --out new.webp --rate 0", {"--rate", "0", "must be"}},
          {"film flat --out new.webp --width 100", {"--width", "100", "must be"}},
          {"film flat --out new.webp --width 100000", {"--width", "100000", "must be"}}});
}

TEST_F(BadCommandLine, OfExportAndReplayIntoAFolderIsRefused) {
  refuse({{"export flat --out folder.csv", {"--out: folder.csv: must be a file, not a folder"}},
          {"export flat --out folder.pvd/", {"--out: folder.pvd/: must be a file, not a folder"}},
          {"replay flat --out folder.html", {"--out: folder.html: must be a file, not a folder"}}});
}

TEST_F(BadCommandLine, OfMonitorIsRefused) {
  refuse({{"monitor now", {"now"}},
          {"monitor --seconds 0", {"--seconds", "0", "must be"}},
          {"monitor --seconds -1", {"--seconds", "-1", "must be"}},
          {"monitor --seconds nan", {"--seconds", "nan", "must be"}},
          {"monitor --seconds inf", {"--seconds", "inf", "must be"}},
          {"monitor --seconds soon", {"--seconds", "soon", "must be"}},
          {"monitor --seconds 1 --interval 0", {"--interval", "0", "must be"}},
          {"monitor --seconds 1 --interval 1e9", {"--interval", "1e9", "must be"}},
          {"monitor --seconds 1 --interval nan", {"--interval", "nan", "must be"}},
          {"monitor --seconds 1 --lcm-url ''", {"--lcm-url"}},
          {"monitor --seconds 1 --lcm-url nonsense", {"--lcm-url", "nonsense", "must begin with"}},
          {"monitor --seconds 1 --lcm-url udpm://nowhere", {"--lcm-url", "udpm://nowhere", "must name a group"}}});
}

#endif

#ifdef TALUS_BULLET

TEST_F(BadCommandLine, OfDecomposeIsRefused) {
  refuse({{"decompose", {"mesh"}},
          {"decompose ''", {"mesh"}},
          {"decompose no_such.obj", {"no_such.obj", "must be"}},
          {"decompose full", {"full", "must be"}},
          {"decompose text", {"text", "must"}},
          {"decompose nan.obj", {"nan.obj:1", "nan", "must be"}},
          {"decompose open.obj", {"edges", "must be 0"}},
          {"decompose open.obj --parts 0", {"--parts", "0"}},
          {"decompose open.obj --parts 65", {"--parts", "65"}},
          {"decompose open.obj --parts few", {"--parts", "few"}},
          {"decompose open.obj --corners 3", {"--corners", "3"}},
          {"decompose open.obj --corners 129", {"--corners", "129"}},
          {"decompose open.obj open.obj", {"open.obj"}}});
}

#endif

}  // namespace
}  // namespace talus::bad_command_lines_test
