// What was found, how sure it is, and what to do next on site: what a diagnosis says first.
#pragma once

#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Plain text, a sentence or two each: on the page, in the terminal and in diagnosis.json.
struct ThreeSentences {
  std::string found, sure, next;
};
ThreeSentences three_sentences(const DiagnosisResult& result);

}  // namespace voussoir
