#pragma once

// The icons in use: code points of Fork Awesome, which are merged into the text font.

#include <array>

namespace oversketch::icon {

inline constexpr const char* kOutline = "\uf044";
inline constexpr const char* kSketch = "\uf040";
inline constexpr const char* kPin = "\uf08d";
inline constexpr const char* kMove = "\uf0b2";
inline constexpr const char* kPan = "\uf256";

inline constexpr const char* kEye = "\uf06e";
inline constexpr const char* kEyeOff = "\uf070";
inline constexpr const char* kCompare = "\uf042";
inline constexpr const char* kPlus = "\uf067";
inline constexpr const char* kMinus = "\uf068";
inline constexpr const char* kTrash = "\uf014";
inline constexpr const char* kUndo = "\uf0e2";
inline constexpr const char* kRedo = "\uf01e";
inline constexpr const char* kSave = "\uf0c7";
inline constexpr const char* kExport = "\uf019";
inline constexpr const char* kFolder = "\uf07b";
inline constexpr const char* kFolderOpen = "\uf07c";
inline constexpr const char* kFile = "\uf016";
inline constexpr const char* kFileText = "\uf0f6";
inline constexpr const char* kPicture = "\uf03e";
inline constexpr const char* kHome = "\uf015";
inline constexpr const char* kDesktop = "\uf108";
inline constexpr const char* kRecent = "\uf017";
inline constexpr const char* kLevelUp = "\uf148";
inline constexpr const char* kSearch = "\uf002";
inline constexpr const char* kZoomIn = "\uf00e";
inline constexpr const char* kZoomOut = "\uf010";
inline constexpr const char* kSettings = "\uf013";
inline constexpr const char* kSliders = "\uf1de";
inline constexpr const char* kLock = "\uf023";
inline constexpr const char* kCheck = "\uf00c";
inline constexpr const char* kClose = "\uf00d";
inline constexpr const char* kStop = "\uf04d";
inline constexpr const char* kWarning = "\uf071";
inline constexpr const char* kInfo = "\uf05a";
inline constexpr const char* kHelp = "\uf059";
inline constexpr const char* kMagic = "\uf0d0";
inline constexpr const char* kRefresh = "\uf021";
inline constexpr const char* kClone = "\uf24d";
inline constexpr const char* kColumns = "\uf0db";
inline constexpr const char* kMore = "\uf141";
inline constexpr const char* kArrowUp = "\uf077";
inline constexpr const char* kArrowDown = "\uf078";
inline constexpr const char* kArrowLeft = "\uf053";
inline constexpr const char* kArrowRight = "\uf054";
inline constexpr const char* kCaretDown = "\uf0d7";
inline constexpr const char* kCaretUp = "\uf0d8";
inline constexpr const char* kCaretRight = "\uf0da";

/// What is rasterised: an icon that is missing here is drawn as a question mark.
inline constexpr std::array kAll = {
    kOutline, kSketch,  kPin,       kMove,      kPan,        kEye,       kEyeOff,     kCompare,   kPlus,     kMinus,
    kTrash,   kUndo,    kRedo,      kSave,      kExport,     kFolder,    kFolderOpen, kFile,      kFileText, kPicture,
    kHome,    kDesktop, kRecent,    kLevelUp,   kSearch,     kZoomIn,    kZoomOut,    kSettings,  kSliders,  kLock,
    kCheck,   kClose,   kStop,      kWarning,   kInfo,       kHelp,      kMagic,      kRefresh,   kClone,    kColumns,
    kMore,    kArrowUp, kArrowDown, kArrowLeft, kArrowRight, kCaretDown, kCaretUp,    kCaretRight};

} // namespace oversketch::icon
