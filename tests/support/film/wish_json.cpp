#include <nlohmann/json.hpp>

#include "tests/support/film/commands.h"

namespace swarmsmith::film {

std::string wish_json(const LabWish& wish) {
  const nlohmann::json json = {{"width", wish.lab.size.width},
                               {"height", wish.lab.size.height},
                               {"seed", wish.lab.seed},
                               {"cameras", wish.lab.cameras},
                               {"robots", wish.lab.robots},
                               {"survey_sigma", wish.lab.survey_sigma_m},
                               {"lens", static_cast<int>(wish.lab.lens)},
                               {"chessboard", wish.lab.chessboard},
                               {"two_tags", wish.lab.two_tags},
                               {"rate", wish.rate_hz},
                               {"exposure", wish.exposure_s},
                               {"readout", wish.readout_s},
                               {"blur", wish.blur_px},
                               {"noise", wish.noise},
                               {"gain", wish.gain},
                               {"gradient", wish.gradient},
                               {"form", static_cast<int>(wish.form)}};
  return json.dump();
}

LabWish wish_from_truth(const std::string& truth) {
  const nlohmann::json json = nlohmann::json::parse(truth).at("wish");
  LabWish wish;
  wish.lab = {{json.at("width"), json.at("height")},
              json.at("seed"),
              json.at("cameras"),
              json.at("robots"),
              json.at("survey_sigma"),
              static_cast<LabLens>(json.at("lens").get<int>()),
              json.at("chessboard"),
              json.value("two_tags", false)};
  wish.rate_hz = json.at("rate");
  wish.exposure_s = json.at("exposure");
  wish.readout_s = json.at("readout");
  wish.blur_px = json.at("blur");
  wish.noise = json.at("noise");
  wish.gain = json.at("gain");
  wish.gradient = json.at("gradient");
  wish.form = static_cast<ClipForm>(json.at("form").get<int>());
  return wish;
}

}  // namespace swarmsmith::film
