#include "io/records/components.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>

#include "io/records/rows.h"
#include "io/records/sets.h"

namespace voussoir {

namespace {

constexpr int longest_number = 9;  // digits of a word that counts as a number

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c));
}

std::string without_ends(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(name_separators);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(name_separators) - begin + 1);
}

int number_of(std::string_view digits) {
  int value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

struct Part {
  std::size_t at = std::string::npos, size = 0;
  bool found() const { return at != std::string::npos; }
};

/// The last run of digits with the value of an azimuth, as it is or as the last three digits of a run ("E05140").
Part find_number(const std::string& name, int azimuth) {
  Part whole, ending;
  for (std::size_t begin = 0; begin < name.size(); ++begin) {
    if (!is_digit(name[begin])) continue;
    std::size_t end = begin;
    while (end < name.size() && is_digit(name[end])) ++end;
    const std::string_view run = std::string_view(name).substr(begin, end - begin);
    if (run.size() <= 3 && number_of(run) % 360 == azimuth % 360) whole = {begin, run.size()};
    if (run.size() > 3 && number_of(run.substr(run.size() - 3)) % 360 == azimuth % 360) ending = {end - 3, 3};
    begin = end;
  }
  return whole.found() ? whole : ending;
}

/// The last place of a separate word; otherwise a word of at least two letters at the end of the name, where stations
/// and directions have no separator ("BCRUP").
Part find_word(const std::string& name, const std::string& word) {
  for (std::size_t at = name.rfind(word); at != std::string::npos;
       at = at == 0 ? std::string::npos : name.rfind(word, at - 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(name[at - 1])) && (end == name.size() || !is_letter(name[end])))
      return {at, word.size()};
  }
  if (word.size() > 1 && name.ends_with(word)) return {name.size() - word.size(), word.size()};
  return {};
}

/// East-west and north-south of K-NET have their direction behind the point: ABC0012401010000.EW.
std::string name_of(const std::string& path) {
  const std::filesystem::path file(path);
  const std::string ending = file.extension().string();
  const bool direction = ending.size() > 2 && component_axis(ending.substr(1)) >= 0;
  return (direction ? file.filename() : file.stem()).string();
}

/// KiK-net has two sensors at a place, EW1 and EW2: two recordings.
std::string sensor_of(const std::string& word) {
  const bool numbered = word.size() == 3 && is_digit(word[2]) && component_axis(word.substr(0, 2)) >= 0;
  return numbered ? fmt::format(".{}", word[2]) : "";
}

}  // namespace

bool is_number(const std::string& word) {
  return !word.empty() && word.size() <= longest_number && std::ranges::all_of(word, is_digit);
}

std::string component_word(const std::string& component) {
  const std::size_t colon = component.find(':');
  std::string word = colon == std::string::npos ? component : component.substr(colon + 1);
  word = without_ends(word);
  word = upper(word.substr(0, word.find(' ')));
  if (word.size() == 3 && word[1] == '-') word.erase(1, 1);
  // The code of the place behind a channel of SEED: BHZ00.
  if (word.size() == 5 && is_letter(word[0]) && is_letter(word[1]) && is_digit(word[3]) && is_digit(word[4]))
    word.resize(3);
  return word;
}

void name_component(RecordComponent& c) {
  const std::string name = name_of(c.path);
  c.word = component_word(c.file.component);
  const Part part = c.word.empty()      ? Part{}
                    : is_number(c.word) ? find_number(name, number_of(c.word))
                                        : find_word(upper(name), c.word);
  if (part.found()) {
    // "BCR140" and "BCR-UP" belong to one recording: separators around the word are removed with it.
    const std::string before = without_ends(name.substr(0, part.at)),
                      after = without_ends(name.substr(part.at + part.size));
    c.set = without_ends(after.empty() ? before : fmt::format("{}.{}", before, after)) + sensor_of(c.word);
  } else if (!c.word.empty()) {
    c.set = without_ends(fmt::format("{} {}", c.file.event, c.file.station));
  } else {
    const std::size_t cut = name.find_last_of(name_separators);
    c.word = cut == std::string::npos ? "" : component_word(name.substr(cut + 1));
    c.set = cut == std::string::npos ? name : without_ends(name.substr(0, cut));
  }
}

bool comes_before(const RecordComponent* a, const RecordComponent* b) {
  if (is_number(a->word) && is_number(b->word)) return number_of(a->word) < number_of(b->word);
  return a->word < b->word;
}

int component_axis(const std::string& name) {
  std::string word = upper(name);
  static const std::map<std::string, int> known = {
      {"X", 0},  {"Y", 1},   {"EW", 0},   {"WE", 0},   {"E", 0},        {"W", 0},  {"NS", 1}, {"SN", 1},
      {"N", 1},  {"S", 1},   {"UD", 2},   {"UP", 2},   {"Z", 2},        {"V", 2},  {"U", 2},  {"DN", 2},
      {"DU", 2}, {"DWN", 2}, {"DOWN", 2}, {"VERT", 2}, {"VERTICAL", 2}, {"VER", 2}};
  // KiK-net numbers its sensors: EW1 in the borehole, EW2 at the surface.
  if (word.size() == 3 && (word[2] == '1' || word[2] == '2') && known.contains(word.substr(0, 2))) word.resize(2);
  if (const auto at = known.find(word); at != known.end()) return at->second;
  // Channels of SEED: band, instrument (seismometer H, accelerometer N, L or G), direction.
  constexpr std::string_view bands = "FGDCESHBMLVU", instruments = "HNLG";
  if (word.size() == 3 && bands.find(word[0]) != std::string_view::npos &&
      instruments.find(word[1]) != std::string_view::npos) {
    if (word[2] == 'E') return 0;
    if (word[2] == 'N') return 1;
    if (word[2] == 'Z') return 2;
  }
  return -1;
}

}  // namespace voussoir
