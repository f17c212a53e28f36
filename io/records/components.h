// Names and directions of components, and the recordings to which they belong by their names.
#pragma once
#include <string>

#include "io/records/format.h"

namespace voussoir {

/// A channel: its file, its direction word, and the name that it shares with the other channels of its recording.
struct RecordComponent {
  std::string path, word, set;
  RecordFile file;
  bool step_told = false;  // a single column, whose time step the user states
  bool alone = false;      // its file has the whole recording
};

/// "1: UP" and "UP  DEG" are "UP", "N-S" is "NS", "BHZ 00" and "BHZ00" (a channel with the code of its place) are
/// "BHZ".
std::string component_word(const std::string& component);
/// Sets `word` and `set`. The shared name is the name of the file without the direction word of the heading; numbers
/// are compared as numbers ("MUL009" and 9, "LOS000" and 360 are the same direction). If the name does not contain the
/// word, event and station of the heading are the shared name. Without a word in the heading, the word is the last part
/// of the name.
void name_component(RecordComponent& component);
/// The order of words: numbers by value, other words alphabetically.
bool comes_before(const RecordComponent* a, const RecordComponent* b);
bool is_number(const std::string& word);

}  // namespace voussoir
