"""Forms in which the engine tells of files, translated where they are told."""

from __future__ import annotations

NAMES = (
    *("Processor", "Storage", "Units", "Missing samples", "Force plates", "Step mm"),
    *("Manufacturer", "Software", "Version"),
)
"""What a file's facts are called."""

VALUES = (
    *("none", "text", "16-bit integers", "32-bit floats"),
    "far-off coordinates or (0, 0, 0)",
    "residuals mean nothing",
    "negative residual ({0} samples)",
    "residual word 65535, read as -1 ({0} samples)",
    "(0, 0, 0) with a valid residual ({0} samples)",
    "no place in a room ({0} samples)",
    *("metres", "centimetres", "millimetres", "inches"),
    "1/0.45 inches (as in files of the CMU database)",
)

ODDITIES = (
    "{0} samples have the residual word 65535, which is -1 without its sign; they were read as "
    "missing.",
    "{0} samples at exactly (0, 0, 0) with a valid residual were read as missing.",
    "{0} samples at exactly (0, 0, 0) were read as missing.",
    "{0} samples whose coordinates are no numbers, or farther out than any room, were read as "
    "missing.",
    "{0} cells that are no numbers were read as missing.",
    "Labels that occur more than once were numbered: {0}.",
    "Of columns that stand more than once the first was read: {0}.",
    "{0} rows are missing; their frames were read as gaps.",
    "Rows are out of order, or very many are missing (after row {0}, for one); those that are there"
    " were read one after the other.",
    "The file marks every sample as invalid, yet has coordinates; they were read as valid.",
    "{0} is gone or holds no prior, so that Markermend's own is used.",
    "{0} does not fit this recording, whose joints are others or stand elsewhere, and is not used.",
    "The file tells no unit of length; by the size of things metres were assumed.",
    "The file tells no unit of length; by the size of things millimetres were assumed.",
    "The file tells no unit of length; by the size of things {0} were assumed.",
    "The file tells no unit of length; millimetres were assumed.",
    "The file tells no unit of length that is known; millimetres were assumed.",
    "The columns tell no unit of length that is known; millimetres were assumed.",
    "No column tells how joints are turned, as qx, qy, qz and qw would.",
    "The file tells no unit; {0} were assumed.",
    "The table has no times; 100 Hz was assumed.",
    "The file does not tell its frame rate; its times were used.",
    "The file does not tell its frame rate; 100 Hz was assumed.",
    "The file tells no rate; 120 Hz was assumed.",
    "The file is cut short: it says that it has {0} frames, {1} are present.",
    "The file is cut short; the poses before its end were read.",
    "The file is cut short; its last pose was left out.",
    "The file is cut short; what its last pose lacks was read as missing.",
    "The file is cut short; its last row was left out.",
    "{0} rows stand twice, line {1} for one; they were read once.",
    "The times in the file grow too fast for seconds; milliseconds were assumed.",
    "The times in the file grow too fast for seconds; microseconds were assumed.",
    "The times in the file grow too fast for seconds; nanoseconds were assumed.",
    "Times in the file jump or stand still (after frame {0}, for one); the rate is that between "
    "most poses.",
    "Frame numbers go from {0} to {1} in line {2}; poses were read one after the other.",
    "Frame numbers leave out {0} poses, from {1} to {2} in line {3} for one; they were read as "
    "gaps.",
    "Times tell of {0} poses that are missing, after frame {1} for one; they were read as gaps, "
    "and frames after them are numbered anew.",
    "Times in the file run backwards and tell no rate; {0} Hz was assumed.",
    "Times in the file stand still and tell no rate; {0} Hz was assumed.",
    "Frames are numbered {0}, {1} and so on; they were read as following one another.",
    "No number stands before {0} poses, in line {1} for one; they were read all the same.",
    "The header counts {0} frames; {1} were read.",
    "Its skeleton is taken to be {0}, the only one here.",
    "Segments the skeleton does not have were left out: {0}.",
    "Segments without movement, left as at rest: {0}.",
)
"""What is odd about a file, as far as operators meet it often."""

PROBLEMS = (
    "{0} is empty; look for another copy of it.",
    "{0} is text in UTF-16, as PowerShell and Excel write it; save it as UTF-8.",
    "{0} is not a C3D file; its first bytes are not a C3D header.",
    "{0} is of an unknown kind; C3D, TRC, CSV, AMC, ASF and BVH can be read.",
    "{0} is damaged: its header puts the parameters at byte {1}, where there are none; look for "
    "another copy of it.",
    "{0} is damaged: its frames would begin beyond its end, at byte {1} of {2}; look for another "
    "copy of it.",
    "{0} holds no frame: by its header it ends before it begins.",
    '{0} is damaged: line {1} opens a quote (") that it does not close.',
    "{0} is damaged: line {1} says “{2}” where {3} should be a number.",
    "{0} is damaged: line {1} has {2} cells, the header {3}.",
    "{0} is damaged: line {1} has {2} numbers for {3} channels.",
    "{0} is damaged: lines {1} and {2} both tell of “{3}” in one frame, and differ.",
    "{0} is damaged: “{1}” in line {2} is no frame number.",
    "{0} would have {1} poses a second, which is no rate of a recording; {2} to {3} Hz can be "
    "read.",
    "There is no file “{0}”; check its name and folder.",
    "There is no take at “{0}”; check its name and folder.",
    "“{0}” is a folder; name a file in it.",
    "“{0}” holds no take ending in {1}; name others, or match them as by “*.csv”.",
    "{0} is damaged: line {1} begins with “{2}”, which is the number of no pose.",
    "{0} is damaged: line {1} has only numbers; it should begin with the name of a segment, or be "
    "the number of a pose.",
    "{0} is damaged: line {1} should give {2} {3} numbers, but reads “{4}”.",
    "{0} is damaged: line {1} tells of {2} a second time in one pose.",
    "{0} holds no pose of this skeleton.",
    "{0} is cut short: no pose follows its header.",
    "{0} is cut short: its last bone has no end.",
    "{0} is no Acclaim skeleton: it has no :root or :bonedata.",
    "{0} is damaged: two bones have the same name.",
    "{0} is damaged: bone {1} has no length or direction.",
    "{0} is damaged: bone {1} does not hang on the root.",
    "{0} is damaged: its hierarchy names {1}, which is no bone.",
    "{0} is damaged: its unit of length, {1} in line {2}, makes no body.",
    "{0} is damaged: its unit of length is {1}.",
    "{0} is damaged: line {1} should have a number of a body, but reads “{2}”.",
    "{0} is damaged: line {1} should have {2} numbers of a body, but reads “{3}”.",
    "{0} is damaged: line {1} names no joint.",
    "{0} is damaged: the parent “{1}” is no joint of it.",
    "{0} is damaged: its frames go from {1} to {2}, with {3} rows.",
    "{0} is no table of joints: it lacks the column “{1}”; it should have {2}.",
    "{0} does not say what “{1}” hangs on; add a column “parent”.",
    "{0} has two columns “{1}”, of which one may tell how joints are turned; call that q{1}.",
    "{0} tells of several bodies (column “{1}”); write one of them into a file.",
    "{0} holds no whole row.",
    "{0} is damaged: it is cut short.",
    "{0} is damaged: it does not begin with HIERARCHY.",
    "{0} is damaged: it has two joints called “{1}”.",
    "{0} is damaged: more poses follow than the {1} that it tells of.",
    "{0} is damaged: “{1}” in line {2} is no finite number.",
    "{0} is no skeleton recording; its name should end in {1}.",
    "{0} should end in {1}, to tell what to write.",
    "{0} needs a skeleton (ASF), and these joints have none: only those of an AMC have, as they "
    "were read; write a CSV.",
    "There is no pose to write into a BVH.",
    "A BVH holds rotations, which this recording has none of; write a CSV.",
    "A BVH holds every joint of every pose, and {0} was never seen; write a CSV.",
    "A BVH has one root; this recording has several.",
    "An AMC cannot say that a segment is never seen, and would show {0} at rest. Write more "
    "frames, repair these gaps first, or write a CSV.",
    "A BVH of these joints could not be read again: {0}; rename joints, or write a CSV.",
    "“{0}” may not be read; check its permissions.",
    "“{0}” cannot be opened: {1}.",
    "{0} could not be written: {1}; nothing was changed, choose another place or free some space.",
)
"""Why a file cannot be opened or written."""

HERE = {
    "{0} needs its skeleton: put the ASF file beside it, named {1}.asf, or say which it is "
    "(denoise --skeleton).": (
        "{0} needs its skeleton: put the ASF file beside it, named {1}.asf, or choose it."
    ),
    "{0} needs its skeleton: none of the ASF files beside it is named {1}.asf. Name the right one "
    "so (what stands before the first _ will do, as in 02.asf for 02_01.amc), or say which it is "
    "(denoise --skeleton).": (
        "{0} needs its skeleton: none of the ASF files beside it is named {1}.asf. Name the right "
        "one so (what stands before the first _ will do, as in 02.asf for 02_01.amc), or choose it."
    ),
    "{0} needs its skeleton: {1}, the only ASF file beside it, does not have {2} as it is there. "
    "Put the right one beside it, named {3}.asf, or say which it is (denoise --skeleton).": (
        "{0} needs its skeleton: {1}, the only ASF file beside it, does not have {2} as it is "
        "there. Put the right one beside it, named {3}.asf, or choose it."
    ),
    "A BVH holds every joint of every pose. Frames in which joints are not known: {0}. Repair "
    "these gaps first, in the window by F, or all of them by markermend clean; or write a CSV.": (
        "A BVH holds every joint of every pose. Frames in which joints are not known: {0}. Repair "
        "these gaps first, {repair} the one under review and {repair_accepted} all that are "
        "accepted; or write a CSV."
    ),
}
"""What advises the command line, and what is told instead in the window, with keys of actions."""

REVIEWS = (
    "The review made of this take at “{0}” goes on here.",
    "The take was exported over its original. What was not repaired of its review goes on here; "
    "the review so far stays in “{0}”.",
    "The take has changed since it was reviewed: what was decided on the {0} markers that are the "
    "same was kept, on {1} it was not; the old review stays in “{2}”.",
    "The take has changed since it was reviewed: what was decided on the {0} joints that are the "
    "same was kept, on {1} it was not; the old review stays in “{2}”.",
)
"""What is said of a review that was there before."""
