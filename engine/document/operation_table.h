#pragma once

#include "engine/document/operation.h"
#include "engine/document/operation_reader.h"

namespace dollytrack {

// The functions of the table in operation.cpp; see ApplyOperation.

// Objects: object_operations.cpp
std::string excludeObject(ProjectState&, const OperationContext&, const OperationReader&);
std::string includeObject(ProjectState&, const OperationContext&, const OperationReader&);
std::string setClass(ProjectState&, const OperationContext&, const OperationReader&);
std::string setFront(ProjectState&, const OperationContext&, const OperationReader&);
std::string moveObjectBy(ProjectState&, const OperationContext&, const OperationReader&);
std::string moveObjects(ProjectState&, const OperationContext&, const OperationReader&);
std::string setTrack(ProjectState&, const OperationContext&, const OperationReader&);
std::string goToTime(ProjectState&, const OperationContext&, const OperationReader&);
std::string setSize(ProjectState&, const OperationContext&, const OperationReader&);
std::string ignoreObjects(ProjectState&, const OperationContext&, const OperationReader&);
std::string onlyObjects(ProjectState&, const OperationContext&, const OperationReader&);
std::string resetObject(ProjectState&, const OperationContext&, const OperationReader&);

// New objects: definition_operations.cpp
std::string merge(ProjectState&, const OperationContext&, const OperationReader&);
std::string group(ProjectState&, const OperationContext&, const OperationReader&);
std::string split(ProjectState&, const OperationContext&, const OperationReader&);

// The plan: plan_operations.cpp, region_operations.cpp
std::string setParameter(ProjectState&, const OperationContext&, const OperationReader&);
std::string setHeightBand(ProjectState&, const OperationContext&, const OperationReader&);
std::string pin(ProjectState&, const OperationContext&, const OperationReader&);
std::string addPoint(ProjectState&, const OperationContext&, const OperationReader&);
std::string movePoint(ProjectState&, const OperationContext&, const OperationReader&);
std::string unpin(ProjectState&, const OperationContext&, const OperationReader&);
std::string removePoint(ProjectState&, const OperationContext&, const OperationReader&);
std::string restorePoint(ProjectState&, const OperationContext&, const OperationReader&);
std::string setStart(ProjectState&, const OperationContext&, const OperationReader&);
std::string setEnd(ProjectState&, const OperationContext&, const OperationReader&);
std::string setMotion(ProjectState&, const OperationContext&, const OperationReader&);
std::string trimMotion(ProjectState&, const OperationContext&, const OperationReader&);
std::string clearMotion(ProjectState&, const OperationContext&, const OperationReader&);
std::string addCameraKey(ProjectState&, const OperationContext&, const OperationReader&);
std::string changeCameraKey(ProjectState&, const OperationContext&, const OperationReader&);
std::string removeCameraKey(ProjectState&, const OperationContext&, const OperationReader&);
std::string addRegion(ProjectState&, const OperationContext&, const OperationReader&);
std::string changeRegion(ProjectState&, const OperationContext&, const OperationReader&);
std::string removeRegion(ProjectState&, const OperationContext&, const OperationReader&);
std::string addNoGo(ProjectState&, const OperationContext&, const OperationReader&);
std::string moveNoGo(ProjectState&, const OperationContext&, const OperationReader&);
std::string renameNoGo(ProjectState&, const OperationContext&, const OperationReader&);
std::string removeNoGo(ProjectState&, const OperationContext&, const OperationReader&);

}  // namespace dollytrack
