#pragma once

// What a `layer.set` and a layer's settings have in common: the one list of their fields.

#include "core/document/command.h"

namespace oversketch {

/// Calls visit(member of LayerSettings, member of LayerSet) for each setting.
template <class Visit>
void for_each_setting(Visit&& visit) {
  visit(&LayerSettings::method, &LayerSet::method);
  visit(&LayerSettings::cell_px, &LayerSet::cell_px);
  visit(&LayerSettings::stiffness, &LayerSet::stiffness);
  visit(&LayerSettings::follow, &LayerSet::follow);
  visit(&LayerSettings::handle_weight, &LayerSet::handle_weight);
  visit(&LayerSettings::iterations, &LayerSet::iterations);
  visit(&LayerSettings::sampling, &LayerSet::sampling);
  visit(&LayerSettings::mode, &LayerSet::mode);
  visit(&LayerSettings::strength, &LayerSet::strength);
  visit(&LayerSettings::domain, &LayerSet::domain);
  visit(&LayerSettings::visible, &LayerSet::visible);
  visit(&LayerSettings::opacity, &LayerSet::opacity);
  visit(&LayerSettings::feather_px, &LayerSet::feather_px);
  visit(&LayerSettings::screening, &LayerSet::screening);
}

/// Takes over what the command gives; returns how many settings that were.
inline int assign_settings(LayerSettings& settings, const LayerSet& given) {
  int count = 0;
  for_each_setting([&](auto setting, auto field) {
    if (!(given.*field)) return;
    settings.*setting = *(given.*field);
    ++count;
  });
  return count;
}

/// The command that gives all of them.
inline LayerSet all_settings(const LayerSettings& settings) {
  LayerSet set;
  for_each_setting([&](auto setting, auto field) { set.*field = settings.*setting; });
  return set;
}

} // namespace oversketch
