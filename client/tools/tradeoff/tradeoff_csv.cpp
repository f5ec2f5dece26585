#include "client/tools/text/csv.h"
#include "client/tools/tradeoff/tradeoff.h"
#include "common/problem.h"

namespace metamer::client {

std::string tradeoff_csv(const Tradeoff& tradeoff) {
  std::string text =
      "method,parameters,prepare_seconds,render_seconds,seconds,relative_to_rgb,mean,median,"
      "percentile_95,percentile_99,maximum,x,y,not_finite,front,failure\r\n";
  const std::optional<double> rgb = rgb_seconds(tradeoff);
  const std::size_t width = tradeoff.plan.width();
  for (const TradeoffRow& row : tradeoff.rows) {
    text += csv_field(row.what.method) + "," + csv_field(row.what.parameters);
    if (row.failure.empty()) {
      for (const double number : {row.prepare, row.render, row.seconds()})
        text += "," + number_text(number);
      text += "," + (rgb ? number_text(row.seconds() / *rgb) : std::string());
      const ErrorStatistics& error = row.error;
      for (const double number :
           {error.mean, error.median, error.percentile_95, error.percentile_99, error.maximum})
        text += "," + number_text(number);
      for (const std::size_t count : {error.at % width, error.at / width, error.not_finite})
        text += "," + std::to_string(count);
      text += std::string(row.front ? ",1" : ",0") + ",";
    } else {
      text += ",,,,,,,,,,,,,0," + csv_field(row.failure);
    }
    text += "\r\n";
  }
  return text;
}

}  // namespace metamer::client
