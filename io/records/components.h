// What a component is called, where it points, and which recording it belongs to by its name.
#pragma once
#include <string>

#include "io/records/format.h"

namespace voussoir {

/// A channel, what it says of its direction, and the name that it shares with its companions.
struct RecordComponent {
  std::string path, word, set;
  RecordFile file;
  bool step_told = false;  // a single column
  bool alone = false;      // its file holds the whole recording
};

/// "1: UP" and "UP  DEG" are "UP", "N-S" is "NS", "BHZ 00" and "BHZ00" (a channel with the code of its place) are
/// "BHZ".
std::string component_word(const std::string& component);
/// Takes the word of the heading out of the name of the file, numbers as numbers: "MUL009" and 9, "LOS000" and 360 name
/// the same direction. Where the name does not hold it, event and station of the heading are what is shared; without a
/// word in the heading it is the last part of the name.
void name_component(RecordComponent& component);
/// Numbers by size, other words by letters.
bool comes_before(const RecordComponent* a, const RecordComponent* b);
bool is_number(const std::string& word);

}  // namespace voussoir
