// The output of a study: Markdown tables and line charts, as plain data.
#pragma once
#include <string>
#include <vector>

#include "viz/page/line_chart.h"

namespace voussoir {

struct Table {
  std::string caption;                         // one line above the table
  std::vector<std::string> columns;            // headings, with units
  std::vector<std::vector<std::string>> rows;  // as many cells as headings
};

struct StudyChart {
  std::string name;  // the picture is convergence_NAME.png
  LineChart chart;
};

struct Study {
  std::string title;
  std::vector<Table> tables;
  std::vector<StudyChart> charts;
};

/// The tables of a study as Markdown, with its title as a heading.
std::string markdown(const Study& study);

/// Order p from two computations with errors ~ h^p: ln(e1/e2) / ln(h1/h2). Not finite if an error is zero.
double measured_order(double error1, double error2, double h1, double h2);
/// "1.98", or "" if there is no order.
std::string order_text(double order);
/// "+0.12 %" of a relative error: three significant digits, but at most six decimals.
std::string percent(double error);

}  // namespace voussoir
