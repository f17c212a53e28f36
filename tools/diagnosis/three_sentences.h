// The first three sentences of a diagnosis: what was found, its certainty, and the next step on site.
#pragma once

#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Plain text of one or two sentences each, used on the page, in the terminal and in diagnosis.json.
struct ThreeSentences {
  std::string found, sure, next;
};
ThreeSentences three_sentences(const DiagnosisResult& result);

}  // namespace voussoir
