#include "viz/page/print_page.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <chrono>
#include <csignal>
#include <filesystem>

#include "solver/base/child.h"
#include "solver/base/error.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

constexpr std::array browsers = {"chromium", "chromium-browser", "google-chrome", "chrome"};
constexpr std::chrono::seconds patience{120};

std::string browser() {
  for (const char* name : browsers)
    if (in_path(name)) return name;
  throw InputError(
      "no browser was found to print the page. Install the package chromium, or open the page in your browser and "
      "print it there");
}

/// The address of a file, with special characters encoded by their bytes.
std::string file_address(const std::string& path) {
  std::string address = "file://";
  for (const char c : fs::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || std::string_view("/-._~").find(c) != std::string_view::npos)
      address += c;
    else
      address += fmt::format("%{:02X}", byte);
  }
  return address;
}

/// A folder for the browser's profile and what it writes, removed at the end.
class Workplace {
 public:
  Workplace() {
    std::string name = (fs::temp_directory_path() / "voussoir-print-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw RunError("a temporary folder cannot be made in {}", fs::temp_directory_path().string());
    path_ = name;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Workplace(const Workplace&) = delete;
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Ends it, with its children, when it takes too long.
Finished wait_patiently(pid_t process) {
  Finished how;
  const auto late = std::chrono::steady_clock::now() + patience;
  while (!has_ended(process, how)) {
    if (std::chrono::steady_clock::now() > late) {
      ::kill(-process, SIGKILL);
      return wait_for(process);
    }
    pause_milliseconds(20);
  }
  return how;
}

}  // namespace

void print_page(const std::string& html, const std::string& pdf) {
  const std::string name = browser();
  const Workplace here;
  const std::string printed = here / "page.pdf";
  Launch launch{.words = {name, "--headless", "--disable-gpu", "--no-first-run", "--no-pdf-header-footer",
                          "--user-data-dir=" + (here / "profile"), "--print-to-pdf=" + printed}};
  if (::geteuid() == 0) launch.words.push_back("--no-sandbox");  // Chromium does not start as root with it
  launch.words.push_back(file_address(html));
  launch.group = Launch::Group::own;
  launch.signal_at_our_end = SIGKILL;
  const LogFile said(here / "said.txt");
  launch.out = launch.err = said.descriptor;
  const Finished how = wait_patiently(start(launch));
  std::error_code failed;
  if (how.status != 0 || !fs::exists(printed, failed))
    throw RunError("{} did not print {} ({})", name, html,
                   how.signal == SIGKILL ? "it took too long" : fmt::format("exit status {}", how.status));
  const std::string part = pdf + ".partial";
  fs::copy_file(printed, part, fs::copy_options::overwrite_existing, failed);
  if (!failed) fs::rename(part, pdf, failed);
  if (failed) throw RunError("cannot write {}: {}", pdf, failed.message());
}

}  // namespace voussoir
