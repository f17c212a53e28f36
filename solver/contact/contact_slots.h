// Slots for contacts in the state. Eight slots form a batch, which belongs to one tile and to contacts with a similar
// number of points. Contacts are added and removed without moving other contacts.
#pragma once
#include <map>

#include "solver/contact/make_contact.h"

namespace voussoir {

/// Assigns slots to contacts. It is created for every search, so that the slots depend only on the state.
class ContactSlots {
 public:
  ContactSlots(const Model& model, State& state, const Branches& branches)
      : model_(model), state_(state), branches_(branches.count) {}
  /// Stores a contact in the lowest free slot that fits, or else in the first slot of a new batch, and returns the
  /// slot.
  std::size_t add(const NewContact& contact);
  /// Frees the slot and adds the dissipated energy of its contact to the sum for removed contacts.
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
