// The damage of a component as a word and as a sentence.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir {

struct DamageClass {
  const char* word;
  double below;  // m, largest opening
};
/// Classes by the width of cracks after Burland, Broms & de Mello (1977), table 1. Upper limits in mm: negligible 0.1,
/// very slight 1, slight 5, moderate 15, severe 25; very severe has none.
const std::vector<DamageClass>& damage_classes();
const char* damage_word(double opening);

/// A length in mm: "3.2 mm", or "less than 0.1 mm" where its decimals would show a zero.
std::string mm_text(double metres, int decimals);
/// The same as a bound: "up to 3.2 mm", "less than 0.1 mm".
std::string bound_text(double metres, int decimals);

/// "severe: joints opened by up to 18 mm (6 mm still open), slid by up to 9 mm; 12 % of the bonded joint area broken".
/// `damage` is a component's entry in summary.json.
std::string damage_sentence(const nlohmann::json& damage);

}  // namespace voussoir
