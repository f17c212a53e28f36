// Evaluates a measurement plan before it is carried out.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/diagnosis/diagnosis_input.h"
#include "viz/page/html.h"

namespace voussoir {

struct PlanResult {
  DiagnosisInput input;
  Detection detection;
};

/// The least amounts that the plan would show on the case, and useful further measurements. Throws InputError.
PlanResult look_at_plan(const DiagnosisRequest& request, const MeasurementPlan& plan);

std::string plan_text(const PlanResult& result);
nlohmann::json plan_json(const PlanResult& result);
std::string plan_page(const PlanResult& result, const std::vector<PagePicture>& pictures);

}  // namespace voussoir
