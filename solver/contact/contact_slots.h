// Where contacts live in the state: slots, eight to a batch, a batch of one tile and of contacts with about as many
// points. Contacts come and go without any other being moved.
#pragma once
#include <map>

#include "solver/contact/make_contact.h"

namespace voussoir {

/// Gives contacts their slots; made anew for every search, so that the slots depend on the state alone.
class ContactSlots {
 public:
  ContactSlots(const Model& model, State& state, const Branches& branches)
      : model_(model), state_(state), branches_(branches.count) {}
  /// Returns the slot: the lowest that is free and fits, or the first of a new batch.
  std::size_t add(const NewContact& contact);
  /// What it has lost goes to the common account of contacts that are gone.
  void remove(std::size_t slot);

 private:
  using Kind = std::pair<std::int32_t, std::int32_t>;  // tile, rows of points
  std::vector<std::size_t>& free_of(Kind kind);
  std::size_t free_slot(Kind kind);
  std::size_t first_of_new_batch(Kind kind);

  const Model& model_;
  State& state_;
  int branches_;
  std::map<Kind, std::vector<std::size_t>> free_;  // descending
};

}  // namespace voussoir
