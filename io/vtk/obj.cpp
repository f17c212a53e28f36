// Our own reader: VTK's drops the borders between objects.
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "io/vtk/surface_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/base/words.h"

namespace voussoir {
namespace {

template <class Number>
std::optional<Number> number(std::string_view word) {
  Number value{};
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : path_(path) {}

  Surface read(const std::string& whole) {
    std::istringstream in(whole);
    std::string text;
    while (std::getline(in, text)) {
      ++line_;
      const std::size_t first = line_;
      while (!text.empty() && text.back() == '\\') {  // goes on in the next line
        text.back() = ' ';
        std::string more;
        if (!std::getline(in, more)) break;
        ++line_;
        text += more;
      }
      read_line(text.substr(0, text.find('#')), first);
    }
    add_objects();
    return std::move(surface_);
  }

 private:
  void read_line(std::string_view text, std::size_t line) {
    const auto words = words_of(text, " \t\r");
    if (words.empty()) return;
    if (words[0] == "v")
      read_vertex(words, line);
    else if (words[0] == "f")
      read_face(words, line);
    else if (words[0] == "o")
      object_ = rest(text), group_.clear(), has_objects_ = true, ++part_;
    else if (words[0] == "g")
      group_ = layer_ = rest(text), ++part_of_group_;
  }

  static std::string rest(std::string_view text) {
    const auto words = words_of(text, " \t\r");
    if (words.size() < 2) return "";
    const std::size_t begin = std::size_t(words[1].data() - text.data());
    const std::size_t end = std::size_t(words.back().data() - text.data()) + words.back().size();
    return std::string(text.substr(begin, end - begin));
  }

  void read_vertex(const std::vector<std::string_view>& words, std::size_t line) {
    Vec3 point;
    for (int k = 0; k < 3; ++k) {
      const auto value = words.size() > std::size_t(k + 1) ? number<double>(words[k + 1]) : std::nullopt;
      if (!value || !std::isfinite(*value))
        throw InputError("{}:{}: a vertex needs three finite numbers, as in 'v 0.0 1.0 2.0'", path_, line);
      point[k] = *value;
    }
    surface_.vertices.push_back(point);
  }

  void read_face(const std::vector<std::string_view>& words, std::size_t line) {
    std::vector<int> loop;
    const auto count = std::int64_t(surface_.vertices.size());
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto index = number<std::int64_t>(words[k].substr(0, words[k].find('/')));
      const std::int64_t vertex = !index ? -1 : *index > 0 ? *index - 1 : count + *index;
      if (!index || *index == 0 || vertex < 0 || vertex >= count)
        throw InputError(
            "{}:{}: face corner '{}' is not one of the {} vertices above it. Indices begin at 1; negative ones count "
            "back from the last vertex.",
            path_, line, shown(words[k]), count);
      loop.push_back(int(vertex));
    }
    if (loop.size() < 3)
      throw InputError("{}:{}: a face has {}; it needs at least 3", path_, line, counted(loop.size(), "corner"));
    surface_.faces.push_back(loop);
    surface_.face_lines.push_back(line);
    face_owner_.push_back({object_, group_, layer_, part_, part_of_group_});
  }

  /// Faces of one object need not stand together; two objects of one name stay two.
  void add_objects() {
    std::map<int, std::size_t> known;
    for (std::size_t f = 0; f < face_owner_.size(); ++f) {
      const Owner& owner = face_owner_[f];
      const int part = has_objects_ ? owner.part : owner.part_of_group;
      const auto [entry, fresh] = known.try_emplace(part, surface_.objects.size());
      if (fresh)
        surface_.objects.push_back(
            {has_objects_ ? owner.object : owner.group, surface_.face_lines[f], {}, has_objects_ ? owner.layer : ""});
      surface_.objects[entry->second].faces.push_back(int(f));
    }
  }

  struct Owner {
    std::string object, group, layer;
    int part = 0, part_of_group = 0;
  };
  std::string path_;
  Surface surface_;
  std::size_t line_ = 0;
  std::string object_, group_;
  std::string layer_;  // a group goes on over objects
  bool has_objects_ = false;
  int part_ = 0, part_of_group_ = 0;
  std::vector<Owner> face_owner_;
};

}  // namespace

Surface parse_obj(const std::string& text, const std::string& path) {
  return ObjReader(path).read(text);
}

}  // namespace voussoir
