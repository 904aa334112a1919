<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name></name>
    <message>
        <source>Markermend</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>That did not work; nothing was changed. The details tell what happened.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Damaged file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is damaged. What can be read of it is shown.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The original is never replaced; repairs can be exported to another file.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work not yet exported</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>this take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Your repairs of {0} are not exported yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep the review to go on later: it is saved beside the take, with its full history.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Discard review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export as floats</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is there already. Replace it?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace the original</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} is the take you opened. Replace it?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A backup of the original is kept beside it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About Markermend</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&lt;h3&gt;Markermend {0}&lt;/h3&gt;&lt;p&gt;Finds damaged intervals in optical motion capture takes, says what they are and how sure it is, and repairs them under your eyes.&lt;/p&gt;&lt;p&gt;Free software under the MIT licence.&lt;/p&gt;</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} on {1}, frames {2}–{3}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker} · {kind} · frames {first}–{last} · {sure:.0%} sure · {status}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Without subject</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept as it is; not a marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Class</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Damaged axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Selection on {marker}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mark as {kind}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame {0} · {1} s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>missing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance to {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure the distance to</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A marker that suits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>X, Y and Z only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Others</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Analog channels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Model outputs: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hide all channels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>  or  </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the plots</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click on an interval</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select it; double click repairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wheel, Ctrl+wheel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom time, zoom values</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle or right drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pan</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shift+drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select a range of frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag an edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the edge of the selected artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the 3D view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Orbit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Shift+drag or middle drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ctrl+drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scrub through time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Gap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peak</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Noise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Slow drift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>gap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>peak</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>noise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>slow drift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open take…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>File</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the demo take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export repaired take…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write a copy in which only repaired samples differ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Quit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Redo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Clear selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Forget the swept range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find a command, marker or artifact…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Type a few letters to do anything or go anywhere</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preferences…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look, language, units, detection and saving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detect artifacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look for gaps, peaks, heavy noise and steps in the whole take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detect slow drifts too</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look for every class; slow drifts take some seconds longer than all the others</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detect after opening</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look for gaps, peaks, noise and steps as soon as a take is open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accept</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The flag is right; the samples stay for now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A false alarm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace the samples by the repair shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preview this repair method for the artifact under review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 3</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 4</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 5</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 6</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 7</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 8</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair method 9</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare repairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>While the key is held, see what every method would do; ↑ and ↓ choose</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reopen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the decision back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Remove from the list</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair all accepted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair every accepted artifact with its best method, as one step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair all like this…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>List the open artifacts of its class, and repair them in one step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject all like this…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>List the open artifacts of its class, and reject them in one step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lower what was rejected several times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Answer yes when asked whether the rest of a sort is to come last</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Previous artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write a note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Say something about it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mark selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make an artifact of the swept range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace the swept range of the marker by the best repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smooth selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the noise out of the swept range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cut selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make the swept range missing; the gap comes under review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap selection with another marker…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exchange the swept range with that of another marker, from here to there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give selection to another marker…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The swept range has the wrong name: it becomes part of another marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rename marker…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the foremost marker another name in the whole take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merge marker into another…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give all samples of the foremost marker to another one that is missing there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose the markers to follow</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click markers in the 3D view; the repair follows these only</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Split artifact at the cursor</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make two artifacts of the one under review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Join artifacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make one of those selected in the queue, else of this one and the next on its marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin one frame earlier</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edges</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin one frame later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End one frame earlier</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End one frame later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Call the artifact under review this</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play or pause</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One frame forward</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One frame back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ten frames forward</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ten frames back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the first frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the last frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the whole take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>View</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the samples before repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap the curves before and after repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the body&apos;s prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the rest of the body says the marker should be</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change the overview</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Overview of damage, of gaps, or of distances to the body&apos;s prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose plots…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose what the plots show</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Light theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dark theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>High contrast theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Theme of the system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reset the layout</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The page about the panel in use</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Help</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keyboard and mouse…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keyboard and mouse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Local regression</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Follows the body around it and joins its own way in and out; the usual choice.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cubic spline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smooth curve of continuous acceleration; best for peaks and up to about 0.1 s.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PCHIP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Piecewise cubic that never overshoots; safer than the spline over longer intervals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Modified Akima</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Piecewise cubic between spline and PCHIP: smooth, with little overshoot.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Straight line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Joins the last good sample before and the first after; for the shortest intervals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exchanges the marker with its counterpart over the interval; nothing is invented.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Savitzky–Golay</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smooths the damaged samples themselves; for noise that still holds the movement.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Loose network</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A small network trained on this take predicts the marker from its body; slow.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Removes the wrong samples and leaves a gap, where no honest repair exists.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>BiLSTM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Long short-term memory in both directions predict the marker from its parent and siblings; trains for seconds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>BoLeRO</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DynaMMo held softly to the distances that markers of a segment keep.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cyclic</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copies the same movement from elsewhere in the take; for gait and other repetitions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DynaMMo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One hidden movement of the whole body; crosses intervals in which nothing is seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Linear network</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A network of 8 linear neurons predicts the marker from its parent and siblings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tanh network</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A network of 8 tanh neurons predicts the marker from its parent and siblings.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Global linear regression</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Least squares on all markers whose distance varies little.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>GRU</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>60 gated recurrent neurons predict the marker from its parent and siblings; trains for seconds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kalman smoother</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moves on under constant acceleration from both sides; for short intervals, with band.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Local GRNN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Average of similar poses of three references in their own system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Local interpolation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A straight line in a system of three references.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Local polynomial regression</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Quadratic regression on three references in their own system.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>LSTM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>60 long short-term memory neurons predict the marker from its parent and siblings; trains for seconds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Low rank</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Completes the matrix of all markers by its main components; for long intervals.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pattern</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Follows one other marker and joins both borders; for markers that move alike.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Weighted PCA</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rebuilds the marker from the main components of the others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Model averaging</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Averages local polynomial, local GRNN, global linear and PCA by likely distances.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Model averaging, all models</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Averages all five models by likely distances.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Model averaging without PCA</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Averages all models but PCA by likely distances.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rigid body</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moves the marker with three or more others of its group; for rigid segments.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>X</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>X coordinate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Y</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Y coordinate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Z</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Z coordinate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accel.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Acceleration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance to another marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off body</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance to the body&apos;s prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Difference to the samples before repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residual in the file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number of cameras in the file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>accepted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>rejected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>repaired</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only what is nearly certain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Balanced</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All that looks odd</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>AlikeDialog</name>
    <message>
        <source>Repair all like this: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject all like this: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At least this sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What will happen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>rejected as a false alarm, left as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>working it out…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left as it is: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No open artifact is like this; look further or be less strict.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working out {0} repairs…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One step, undone by one Ctrl+Z.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} are left as they are.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ArtifactPage</name>
    <message>
        <source>Class</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Class of the artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whether {0} is wrong</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axis {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}, as numbered in the file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Why</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} frames, {1:.2f} s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No reason was given.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>nearly certain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>likely</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>possible</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repaired: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open: not decided yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accepted: to be repaired</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rejected: a false alarm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Bulk</name>
    <message>
        <source>{0} artifacts come last now.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair {0} artifacts alike ({1})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} repaired.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} rejected.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Candidates</name>
    <message>
        <source>Repairs compared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working out what every method would do…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No method has an answer here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>↑ ↓ choose, F repairs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} more have no answer here.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Commands</name>
    <message>
        <source>Open take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Opening {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking at the body</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers were renamed meanwhile; detect again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>all kinds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sudden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 artifact found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} artifacts found.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking for artifacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair all accepted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is nothing to repair: no artifact is accepted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The review changed meanwhile; repair again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair {0} artifacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} repaired.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} left as they are: {1}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Undone: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Done again: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} markers, {1} frames at {2:g} Hz.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open in another window: this one is read-only.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>An interrupted review was recovered; last step: {0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>opened</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Decisions</name>
    <message>
        <source>Accept</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The flag is right; the samples stay for now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A false alarm, never touched</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace the samples by the repair shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reopen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the decision back</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ExportDialog</name>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export repairs nothing by itself: only what you repaired differs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Model outputs in this file (angles, forces, moments…) were computed from the markers before their repair and no longer match: {0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write into the file what was repaired, and how</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name in the file the model outputs that no longer match</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show list</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} not decided</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} accepted but not repaired</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every artifact is decided. Export?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export with artifacts left as they are: {0}?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Exporter</name>
    <message>
        <source>Exporting {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exported to {0}; 1 sample differs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exported to {0}; {1} samples differ.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The original is kept as {0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export repaired take</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>FloatingButtons</name>
    <message>
        <source>Decide about this artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accept: the flag is right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reject: a false alarm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair: replace the samples as shown</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HandWork</name>
    <message>
        <source>Repairing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smoothing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap {0} with</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>marked by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames of {0} are in truth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rename {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Merge {0} into</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The review changed meanwhile; do it again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no other marker to choose.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HistoryPanel</name>
    <message>
        <source>History</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click a step to go there; it is undone and done again in order.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What you do appears here; every step can be undone.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Inspector</name>
    <message>
        <source>Open a take to see what there is to say about it.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MainWindow</name>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>History</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3D view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Details</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Review queue</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Toolbar</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detect</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Prediction</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Panels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recent takes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>None yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> (read-only)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Manual</name>
    <message>
        <source>Markermend&apos;s manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Page of the manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contents</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find in the manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MarkerModel</name>
    <message>
        <source>Marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Artifacts that are not decided yet, by class</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the frames in which the marker is missing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Missing in {0:.2f} % of the frames</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MarkerTree</name>
    <message>
        <source>Filter markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Worst first: a flat list, the markers with most open artifacts on top</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Worst first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take to see its markers here.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MethodList</name>
    <message>
        <source>More methods…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More methods</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair methods without a key of their own</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The method that is expected to err least here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Best for this artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} (key {1})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working out the repair… {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repaired. Reopen it to try another method.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working out the repair…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No repair: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no answer here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, expected error {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>, following {0}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ModeButton</name>
    <message>
        <source>Damage</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Gaps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Residual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the overview shows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Overview: {0}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>NoteLine</name>
    <message>
        <source>Nothing written yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept with the review; shown in the queue and in reports</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Notice</name>
    <message>
        <source>Leave them</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>You rejected {0} of {1} decided as {2} on {3}. Make the other {4} less sure, so that they come last?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lower them ({0})</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Overview</name>
    <message>
        <source>Overview of the whole take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame {frame} · {time:.2f} s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} off its body</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The whole take appears here once one is open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working out residuals… {0:.0%}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Palette</name>
    <message>
        <source>Find a command, marker or artifact</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Found</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PlotHeader</name>
    <message>
        <source>Readout</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plots</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose what the plots show</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring {marker} to the front</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>and {count} more</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Preferences</name>
    <message>
        <source>Preferences</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As delivered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Light</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dark</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>High contrast</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colours for colour-blind eyes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose the colour of {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Classes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Language</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Holds from the next start on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Numbers and space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>millimetres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>centimetres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>metres</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the window shows; files keep their own unit.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axis that points up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the take suggests</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Detect after opening a take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sensitivity</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Higher finds more and raises more false alarms.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>only when a take is closed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>every </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each step is kept at once in any case, also through a crash.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as many as there are cores</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Processes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Used to look for slow drifts in long takes.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preset “{0}”</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preset “{0}”, which is gone</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As dialled</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colour of {0}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>QueueModel</name>
    <message>
        <source>Status</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Class</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Why</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accepted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open ones first, the worst on top: size times confidence</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>References</name>
    <message>
        <source>Click the markers in the 3D view that {0} is to follow.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ReviewQueue</name>
    <message>
        <source>Review queue</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which decisions are listed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accepted, not repaired</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Decided</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Filter by marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair, each by its best method</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} decided</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take to review its artifacts here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This file has no markers, so there is nothing to review.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing was found. Sweep over a curve with Shift to mark by hand.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing found yet. {0} looks for artifacts.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Review: Detect artifacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {0} artifacts are decided. {1} exports the repaired take.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>File: Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No artifact matches these filters.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Scene</name>
    <message>
        <source>3D view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show everything (double click)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep the body in the middle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Trails of all markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Names of all markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take to see it in space.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One square: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axis that points up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the take suggests</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SelectionPage</name>
    <message>
        <source>Mark the swept frames as: {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cut</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give away…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mark the selection as</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Do something to it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Selection on {0}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames {0} to {1}: {2} frames, {3:.2f} s</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ShortcutSheet</name>
    <message>
        <source>Keyboard and mouse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find by name or key</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys as in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Actions and keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New key</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use this key</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No key</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As in the preset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take this key</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} belongs to “{1}”, which would lose it.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>StatusLine</name>
    <message>
        <source>Progress</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Artifacts decided, time for each, and time spent on the take without pauses</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0} of {1} decided</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> · {0:.1f} s each · {1:.1f} min</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>TakePage</name>
    <message>
        <source>Take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frames</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Duration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Subjects</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Other points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Analog</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Events</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Missing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{0:.2f} % of all samples</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>TrajectoryPanel</name>
    <message>
        <source>Trajectories</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plots of the shown markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No take is open</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take, or drop one onto the window.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No marker is shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check markers in the tree, or go to an artifact in the review queue.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To {0}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Transport</name>
    <message>
        <source>Frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame number, as in the file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time since the first frame, and length of the take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed of playback</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the first frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One frame back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One frame forward</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the last frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repeat what the plots show</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pause</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Welcome</name>
    <message>
        <source>Open a take to mend</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drop a C3D, TRC or CSV file here, or begin with the demo take.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open take…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a take</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the demo take</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>_Steps</name>
    <message>
        <source>As opened</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>self._panel</name>
    <message>
        <source>Plots</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
