// The page that shows a run in three dimensions: written by the program, looked at by Chromium where there is one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "io/hdf5/assembly_file.h"
#include "solver/base/child.h"
#include "solver/base/error.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// What Chromium makes of a page: its elements after the scripts, and what the console said.
struct Looked {
  std::string page, console;
};

/// Without a network: every name is unknown. Throws RunError where there is no Chromium.
Looked look_at(const std::string& file, const std::string& hash, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"chromium",
                                    "--headless=new",
                                    "--no-sandbox",
                                    "--disable-dev-shm-usage",
                                    "--enable-logging=stderr",
                                    "--virtual-time-budget=8000",
                                    "--window-size=1200,800",
                                    "--host-resolver-rules=MAP * ~NOTFOUND",
                                    "--user-data-dir=" + file + ".profile"};
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--dump-dom", "file://" + file + "#" + hash});
  const Answer answer = ask(words);
  Looked looked{answer.out, ""};
  const std::regex line("[^\n]*CONSOLE[^\n]*\n");
  for (std::sregex_iterator it(answer.err.begin(), answer.err.end(), line), end; it != end; ++it)
    looked.console += it->str();
  return looked;
}

const std::vector<std::string> software = {"--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"};

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

struct ViewOfARun : testing::Test {
  static inline std::unique_ptr<Folder> folder;
  static inline bool built = true;
  Surroundings there{.folder = folder->path()};

  static void SetUpTestSuite() {
    folder = std::make_unique<Folder>();
    write_wall(*folder);
    run_whole(*folder, "wall.toml", "run");
    folder->write("run/report.html", "to be written again");
    const Outcome outcome = voussoir({"view", "run"}, {.folder = folder->path()});
    built = outcome.err.find("built without three.js") == std::string::npos;
    EXPECT_EQ(outcome.status == 0, built) << outcome.err;
  }
  static void TearDownTestSuite() { folder.reset(); }
  void SetUp() override {
    if (!built) GTEST_SKIP() << "built without three.js (libjs-three)";
  }
};

TEST_F(ViewOfARun, IsOneFileThatLoadsNothing) {
  std::string page = bytes_of(*folder / "run/view.html");
  ASSERT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_NE(page.find("Permission is hereby granted, free of charge"), std::string::npos) << "the licence of three.js";
  // three.js can load things when it is told to; our own parts never tell it.
  const std::size_t licence = page.find("<script id=\"licence\""), scene = page.find("<script id=\"scene\"");
  ASSERT_LT(licence, scene);
  page.erase(licence, scene - licence);
  for (const char* word : {"http:", "https:", "src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest", "Loader"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_LT(page.size(), 300000U);
}

TEST_F(ViewOfARun, ReportLinksToIt) {
  const std::string report = bytes_of(*folder / "run/report.html");
  EXPECT_NE(report.find("<a href=\"view.html\">"), std::string::npos);
  EXPECT_EQ(report.find("<script"), std::string::npos);
}

TEST_F(ViewOfARun, GoesWhereItIsTold) {
  const Outcome outcome =
      voussoir({"view", "run/assembly.h5", "-o", "out/wall.html", "--title", "A <wall>", "-q"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const std::string page = bytes_of(*folder / "out/wall.html");
  EXPECT_NE(page.find("<title>A &lt;wall&gt;</title>"), std::string::npos);
  const Outcome few = voussoir({"view", "run", "-o", "few.html", "--frames", "2"}, there);
  ASSERT_EQ(few.status, 0) << few.err;
  const std::size_t blocks = read_assembly(*folder / "run/assembly.h5").blocks.size();
  EXPECT_NE(few.out.find(fmt::format("few.html: {} blocks, 2 frames", blocks)), std::string::npos) << few.out;
  const Outcome state = voussoir({"view", "run/checkpoints/00000.400.h5"}, there);
  ASSERT_EQ(state.status, 0) << state.err;
  EXPECT_TRUE(exists(*folder / "00000.400_view.html"));
}

TEST_F(ViewOfARun, WrongWishesAreRefused) {
  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& pieces) {
    words.insert(words.begin(), "view");
    expect_error(voussoir(words, there), 2, pieces);
  };
  folder->write("empty/note", "");
  folder->write("still/vtk/blocks.pvd", "<VTKFile type=\"Collection\"><Collection/></VTKFile>");
  folder->write("found/diagnosis.json", "{}");
  refused({"nowhere"}, {"no file or folder nowhere"});
  refused({"empty"}, {"empty has nothing to view", "frames of a run", "modes.h5", "diagnosis.json"});
  refused({"still"}, {"still has no frames", "fields_every"});
  refused({"found"}, {"found has no mode shapes", "modes_before.pvd", "diagnose again"});
  refused({"wall.toml"}, {"wall.toml cannot be viewed", "voussoir generate"});
  refused({"run/history.h5"}, {"history.h5"});
  refused({"run", "--frames", "0"}, {"--frames"});
  refused({"run", "-o", "page.png"}, {"page.png", ".html"});
}

/// Stones of the wall are clicked at by where they stand, and named by the page.
TEST_F(ViewOfARun, AClickNamesTheStone) {
  const Assembly assembly = read_assembly(*folder / "run/assembly.h5");
  std::string hash = "view=front&frame=0&amplification=0", expected;
  for (std::size_t i = 0; i < assembly.blocks.size(); i += 5) {
    const Vec3& c = assembly.blocks[i].centroid;
    hash += fmt::format("&click={},{},{}", c.x(), c.y(), c.z());
    expected +=
        block_label(assembly, std::int64_t(i)) + (assembly.blocks[i].fixed ? ", moves with the ground; " : "; ");
  }
  hash += "&click=0,0,-40";
  try {
    const Looked looked = look_at(*folder / "run/view.html", hash, software);
    EXPECT_EQ(looked.console, "");
    EXPECT_NE(looked.page.find("data-ready=\"yes\""), std::string::npos) << looked.page.substr(0, 2000);
    EXPECT_EQ(between(looked.page, "<output id=\"report\" hidden=\"\">", "</output>"), expected + "nothing; ");
  } catch (const RunError& error) {
    GTEST_SKIP() << error.what();
  }
}

/// Keys and two fingers, as events of the page: what the controls say after each, and whether a place of the picture
/// that was beside the wall shows it once the fingers have spread.
TEST_F(ViewOfARun, KeysAndFingersAreObeyed) {
  const std::string script = R"(<script>
const poll = setInterval(() => {
  if (document.body.dataset.ready !== "yes") return;
  clearInterval(poll);
  const told = [], text = (id) => document.getElementById(id).textContent, canvas = document.getElementById("view");
  const key = (name) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
  const point = (kind, id, x, y) => canvas.dispatchEvent(new PointerEvent(kind, {
    pointerId: id, isPrimary: id === 1, pointerType: "touch", clientX: x, clientY: y, bubbles: true }));
  key("Home"); told.push(text("label"));
  key("ArrowRight"); told.push(text("label"));
  key("End"); key("ArrowLeft"); key("ArrowRight"); key("ArrowRight"); told.push(text("label"));
  for (let k = 0; k < 9; ++k) key("-");
  told.push(text("amplified")); key("+"); told.push(text("amplified"));
  const colour = document.getElementById("colour"), first = colour.value;
  key("c"); told.push(colour.value !== first);
  key(" "); told.push(document.getElementById("play").getAttribute("aria-label")); key(" ");
  key("h"); told.push(document.getElementById("help").open); document.getElementById("help").close();
  key("1"); key("Home");
  const x = canvas.clientWidth / 2, y = canvas.clientHeight / 2;
  const tap = () => { point("pointerdown", 1, x, 4); point("pointerup", 1, x, 4); return document.getElementById("stone").hidden; };
  told.push(tap() ? "air" : "stone");
  point("pointerdown", 1, x - 20, y); point("pointerdown", 2, x + 20, y);
  for (let k = 1; k <= 20; ++k) { point("pointermove", 1, x - 20 - 9 * k, y); point("pointermove", 2, x + 20 + 9 * k, y); }
  point("pointerup", 2, x + 200, y); point("pointerup", 1, x - 200, y);
  told.push(tap() ? "air" : "stone");
  key("Escape"); told.push(document.getElementById("stone").hidden ? "none" : "picked");
  document.getElementById("report").textContent = told.join("; ");
}, 50);
</script>)";
  const std::string page = bytes_of(*folder / "run/view.html");
  folder->write("driven.html", page.substr(0, page.rfind("</body>")) + script + "</body>\n</html>\n");
  try {
    const Looked looked = look_at(*folder / "driven.html", "", software);
    EXPECT_EQ(looked.console, "");
    EXPECT_EQ(between(looked.page, "<output id=\"report\" hidden=\"\">", "</output>"),
              "t = 0.000 s; t = 0.200 s; t = 0.600 s; × 0; × 1; true; Stop; true; air; stone; none");
  } catch (const RunError& error) {
    GTEST_SKIP() << error.what();
  }
}

/// Large numbers and a long name of a component: no table of the picked stone is wider than its box.
TEST_F(ViewOfARun, TheTablesOfAStoneFitTheirBox) {
  const std::string script = R"(<script>
const poll = setInterval(() => {
  const rows = [...document.querySelectorAll("#stone tr")], box = document.getElementById("stone");
  if (document.body.dataset.ready !== "yes" || !rows.length) return;
  clearInterval(poll);
  for (const row of rows)
    [...row.querySelectorAll("td")].forEach((cell, k) => {
      if (row.cells.length > 2) cell.textContent = k > 0 ? "−12345" : "12345 restraint";
      else if (k > 0) cell.textContent = "−0.00123, −12.3, −12.3";
    });
  document.getElementById("report").textContent = `${box.scrollWidth - box.clientWidth} of ${rows.length > 8}`;
}, 50);
</script>)";
  const std::string page = bytes_of(*folder / "run/view.html");
  folder->write("picked.html", page.substr(0, page.rfind("</body>")) + script + "</body>\n</html>\n");
  const Vec3 c = read_assembly(*folder / "run/assembly.h5").blocks[5].centroid;
  try {
    const Looked looked = look_at(*folder / "picked.html",
                                  fmt::format("view=front&frame=0&click={},{},{}", c.x(), c.y(), c.z()), software);
    EXPECT_EQ(between(looked.page, "<output id=\"report\" hidden=\"\">", "</output>"), "0 of true");
  } catch (const RunError& error) {
    GTEST_SKIP() << error.what();
  }
}

TEST_F(ViewOfARun, WithoutWebGLThePageSaysSo) {
  try {
    const Looked looked = look_at(*folder / "run/view.html", "", {"--disable-3d-apis"});
    const std::string said = between(looked.page, "<p id=\"message\" role=\"alert\">", "</p>");
    EXPECT_NE(said.find("offers no WebGL 2"), std::string::npos) << looked.page.substr(0, 2000);
  } catch (const RunError& error) {
    GTEST_SKIP() << error.what();
  }
}

TEST(ViewOfModes, SwingsTheirShapes) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  const Outcome modal = voussoir({"modal", "wall.toml", "-o", "modes", "--modes", "3", "--no-pictures"}, there);
  ASSERT_EQ(modal.status, 0) << modal.err;
  const Outcome outcome = voussoir({"view", "modes/modes.h5", "-o", "modes.html"}, there);
  if (outcome.err.find("built without three.js") != std::string::npos) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 frames"), std::string::npos) << outcome.out;
  const std::string page = bytes_of(folder / "modes.html");
  EXPECT_NE(page.find("\"modes\":true"), std::string::npos);
  EXPECT_NE(page.find("\"mode 1: "), std::string::npos);
  EXPECT_EQ(voussoir({"view", "modes", "-o", "same.html", "--title", "modes"}, there).status, 0);
  std::filesystem::remove(folder / "modes/vtk/modes.pvd");
  expect_error(voussoir({"view", "modes"}, there), 2, {"modes.h5 has no mode shapes", "modes.pvd"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
