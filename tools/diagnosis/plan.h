// What sensors would show that are not there yet.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/diagnosis/diagnosis_input.h"
#include "viz/page/html.h"

namespace voussoir {

struct PlanResult {
  DiagnosisInput input;
  Detection detection;
};

/// The least amounts that a plan would show on the case, and what would show less. Throws InputError.
PlanResult look_at_plan(const DiagnosisRequest& request, const MeasurementPlan& plan);

std::string plan_text(const PlanResult& result);
nlohmann::json plan_json(const PlanResult& result);
std::string plan_page(const PlanResult& result, const std::vector<PagePicture>& pictures);

}  // namespace voussoir
