#pragma once

/// Every name the node shows to others, in one place; all can be remapped (ros.md 15).

#include <string>

namespace sensory_growth::node::names {

// Private topics in.
inline constexpr char kPointSource[] = "point_source";
inline constexpr char kLightDirection[] = "light_direction";

// Relative topics in, of standard types.
inline constexpr char kClickedPoint[] = "clicked_point";
inline constexpr char kSun[] = "sun";

// Private, both ways: stimulus_handles/update, stimulus_handles/update_full, stimulus_handles/feedback.
inline constexpr char kStimulusHandles[] = "stimulus_handles";

// Private topics out.
inline constexpr char kOrgans[] = "organs";  // organs/<id>/state
inline constexpr char kState[] = "state";
inline constexpr char kStatus[] = "status";
inline constexpr char kStimuli[] = "stimuli";
inline constexpr char kAppliedCommands[] = "applied_commands";
inline constexpr char kCheckpoint[] = "checkpoint";
inline constexpr char kScenario[] = "scenario";
inline constexpr char kProtocol[] = "protocol";
inline constexpr char kParameters[] = "parameters";
inline constexpr char kMarkers[] = "markers";

// Topics and service of the protocol of dynamic_reconfigure, which prescribes their names.
inline constexpr char kParameterDescriptions[] = "parameter_descriptions";
inline constexpr char kParameterUpdates[] = "parameter_updates";
inline constexpr char kSetParameters[] = "set_parameters";

// Absolute topics out.
inline constexpr char kClock[] = "/clock";
inline constexpr char kTf[] = "/tf";
inline constexpr char kTfStatic[] = "/tf_static";

// Private services.
inline constexpr char kPause[] = "pause";
inline constexpr char kResume[] = "resume";
inline constexpr char kReset[] = "reset";
inline constexpr char kStep[] = "step";
inline constexpr char kSetParameter[] = "set_parameter";
inline constexpr char kSetGravity[] = "set_gravity";
inline constexpr char kSpawnOrgan[] = "spawn_organ";
inline constexpr char kRemoveOrgan[] = "remove_organ";
inline constexpr char kSetPointSource[] = "set_point_source";
inline constexpr char kSetLightDirection[] = "set_light_direction";
inline constexpr char kListStimuli[] = "list_stimuli";
inline constexpr char kSetRealTimeFactor[] = "set_real_time_factor";
inline constexpr char kSaveCheckpoint[] = "save_checkpoint";
inline constexpr char kLoadCheckpoint[] = "load_checkpoint";
inline constexpr char kStartRecording[] = "start_recording";
inline constexpr char kSplitRecording[] = "split_recording";
inline constexpr char kStopRecording[] = "stop_recording";

// Ids of the stimuli that topics of standard types set.
inline constexpr char kClickedLamp[] = "clicked_";  // and a number
inline constexpr char kSunLight[] = "sun";

// Handles: that of a stimulus is called <layer>/<id> like its marker. Ids of stimuli that menus add, with a number.
inline constexpr char kNewHandle[] = "new";
inline constexpr char kNewLamp[] = "lamp_";
inline constexpr char kNewLight[] = "light_";

// Frames of an organ, <prefix><organ>/<frame>.
inline constexpr char kBaseFrame[] = "base";
inline constexpr char kTipFrame[] = "tip";
inline constexpr char kStationFrame[] = "station_";  // station_1 is nearest to the base

// Marker namespaces: <organ>/<layer>, and <layer>/<id> for stimuli.
inline constexpr char kBodyMarker[] = "body";
inline constexpr char kTipMarker[] = "tip";
inline constexpr char kWallMarker[] = "wall";
inline constexpr char kSpringMarker[] = "spring";
inline constexpr char kHeldApexMarker[] = "held_apex";
inline constexpr char kSourceMarker[] = "source";
inline constexpr char kLampMarker[] = "point_source";
inline constexpr char kLightMarker[] = "light_direction";
inline constexpr char kLegendMarker[] = "legend";

// Loggers, children of ros.sensory_growth.
inline constexpr char kLogSimulation[] = "sim";
inline constexpr char kLogRos[] = "ros";
inline constexpr char kLogRecording[] = "recording";

}  // namespace sensory_growth::node::names
