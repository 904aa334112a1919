<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name></name>
    <message>
        <source>Markermend</source>
        <translation>Markermend</translation>
    </message>
    <message>
        <source>That did not work; nothing was changed. The details tell what happened.</source>
        <translation>Das ging nicht; nichts wurde geändert. Die Einzelheiten sagen, was geschah.</translation>
    </message>
    <message>
        <source>What you choose is copied beside it, under its name.</source>
        <translation>Was Sie wählen, wird unter ihrem Namen neben die Aufnahme kopiert.</translation>
    </message>
    <message>
        <source>Choose skeleton…</source>
        <translation>Skelett wählen…</translation>
    </message>
    <message>
        <source>This take</source>
        <translation>Diese Aufnahme</translation>
    </message>
    <message>
        <source>Damaged file</source>
        <translation>Beschädigte Datei</translation>
    </message>
    <message>
        <source>{0} is damaged. What can be read of it is shown.</source>
        <translation>{0} ist beschädigt. Gezeigt wird, was sich davon lesen lässt.</translation>
    </message>
    <message>
        <source>The original is never replaced; repairs can be exported to another file.</source>
        <translation>Das Original wird nie ersetzt; Reparaturen lassen sich in eine andere Datei exportieren.</translation>
    </message>
    <message>
        <source>{0} is written, but some joints are not where you reviewed them there.</source>
        <translation>{0} ist geschrieben, aber einige Gelenke liegen darin nicht dort, wo Sie sie bei der Durchsicht gesehen haben.</translation>
    </message>
    <message>
        <source>{0} more</source>
        <translation>{0} weitere</translation>
    </message>
    <message>
        <source>Work not yet exported</source>
        <translation>Arbeit noch nicht exportiert</translation>
    </message>
    <message>
        <source>this take</source>
        <translation>dieser Aufnahme</translation>
    </message>
    <message>
        <source>Your repairs of {0} are not exported yet.</source>
        <translation>Ihre Reparaturen an {0} sind noch nicht exportiert.</translation>
    </message>
    <message>
        <source>You changed no sample of {0}, but its review would be lost.</source>
        <translation>Sie haben an {0} keinen Messwert geändert, aber die Durchsicht ginge verloren.</translation>
    </message>
    <message>
        <source>You changed no sample of {0}, but its review and its new names would be lost.</source>
        <translation>Sie haben an {0} keinen Messwert geändert, aber die Durchsicht und die neuen Namen gingen verloren.</translation>
    </message>
    <message>
        <source>Keep the review to go on later: it is saved beside the take, with its full history.</source>
        <translation>Behalten Sie die Durchsicht, um später weiterzumachen: Sie wird mit ihrem ganzen Verlauf neben der Aufnahme gespeichert.</translation>
    </message>
    <message>
        <source>Keep the review to go on later: it is saved in {0}, with its full history.</source>
        <translation>Behalten Sie die Durchsicht, um später weiterzumachen: Sie wird mit ihrem ganzen Verlauf in {0} gespeichert.</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>Keep review</source>
        <translation>Durchsicht behalten</translation>
    </message>
    <message>
        <source>Discard review</source>
        <translation>Durchsicht verwerfen</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>An angle is told from the bone above it: where that is still missing these are not in the file: {0}. Repair what they hang on, too.</source>
        <translation>Ein Winkel bezieht sich auf den Knochen darüber: Wo dieser noch fehlt, sind diese Gelenke nicht in der Datei: {0}. Reparieren Sie auch die Gelenke, an denen sie hängen.</translation>
    </message>
    <message>
        <source>Its bones are rigid, so that joints come only as near as these allow, also those beside a repair that you left as they were. At most they are off by: {0}.</source>
        <translation>Ihre Knochen sind starr, sodass Gelenke nur so nahe kommen, wie diese es zulassen, auch solche neben einer Reparatur, die Sie ließen, wie sie waren. Größte Abweichungen: {0}.</translation>
    </message>
    <message>
        <source>A CSV or C3D file has every joint where you see it.</source>
        <translation>Eine CSV- oder C3D-Datei hat jedes Gelenk da, wo Sie es sehen.</translation>
    </message>
    <message>
        <source>Export as floats</source>
        <translation>Als Gleitkommazahlen exportieren</translation>
    </message>
    <message>
        <source>{0} is there already. Replace it?</source>
        <translation>{0} gibt es schon. Ersetzen?</translation>
    </message>
    <message>
        <source>Replace the original</source>
        <translation>Original ersetzen</translation>
    </message>
    <message>
        <source>{0} is the take you opened. Replace it?</source>
        <translation>{0} ist die geöffnete Aufnahme. Ersetzen?</translation>
    </message>
    <message>
        <source>A backup of the original is kept beside it.</source>
        <translation>Eine Sicherung des Originals bleibt daneben liegen.</translation>
    </message>
    <message>
        <source>Replace</source>
        <translation>Ersetzen</translation>
    </message>
    <message>
        <source>About Markermend</source>
        <translation>Über Markermend</translation>
    </message>
    <message>
        <source>&lt;h3&gt;Markermend {0}&lt;/h3&gt;&lt;p&gt;Finds damaged intervals in optical motion capture takes, says what they are and how sure it is, and repairs them under your eyes.&lt;/p&gt;&lt;p&gt;Free software under the MIT licence.&lt;/p&gt;</source>
        <translation>&lt;h3&gt;Markermend {0}&lt;/h3&gt;&lt;p&gt;Findet beschädigte Abschnitte in optischen Bewegungsaufnahmen, sagt, was sie sind und wie sicher das ist, und repariert sie unter Ihren Augen.&lt;/p&gt;&lt;p&gt;Freie Software unter der MIT-Lizenz.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>{0} on {1}, frames {2}–{3}</source>
        <translation>{0} an {1}, Frames {2}–{3}</translation>
    </message>
    <message>
        <source>{0} on {1}, frame {2}</source>
        <translation>{0} an {1}, Frame {2}</translation>
    </message>
    <message>
        <source>{marker} · {kind} · frames {first}–{last} · {sure:.0%} sure · {status}</source>
        <translation>{marker} · {kind} · Frames {first}–{last} · zu {sure:.0%} sicher · {status}</translation>
    </message>
    <message>
        <source>Without subject</source>
        <translation>Ohne Person</translation>
    </message>
    <message>
        <source>Unlabelled</source>
        <translation>Unbenannt</translation>
    </message>
    <message>
        <source>Other points</source>
        <translation>Andere Punkte</translation>
    </message>
    <message>
        <source>Kept as it is; not a marker</source>
        <translation>Bleibt, wie es ist; kein Marker</translation>
    </message>
    <message>
        <source>Kept as it is</source>
        <translation>Bleibt, wie es ist</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Damaged axes</source>
        <translation>Beschädigte Achsen</translation>
    </message>
    <message>
        <source>Selection on {marker}</source>
        <translation>Auswahl an {marker}</translation>
    </message>
    <message>
        <source>Mark as {kind}</source>
        <translation>Kennzeichnen als: {kind}</translation>
    </message>
    <message>
        <source>Frame {0} · {1} s</source>
        <translation>Frame {0} · {1} s</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>filled</source>
        <translation>gefüllt</translation>
    </message>
    <message>
        <source>edited</source>
        <translation>bearbeitet</translation>
    </message>
    <message>
        <source>Distance to {0}</source>
        <translation>Abstand zu {0}</translation>
    </message>
    <message>
        <source>Measure the distance to</source>
        <translation>Abstand messen zu</translation>
    </message>
    <message>
        <source>A marker that suits</source>
        <translation>Einem passenden Marker</translation>
    </message>
    <message>
        <source>X, Y and Z only</source>
        <translation>Nur X, Y und Z</translation>
    </message>
    <message>
        <source>Others</source>
        <translation>Übrige</translation>
    </message>
    <message>
        <source>Analog channels</source>
        <translation>Analogkanäle</translation>
    </message>
    <message>
        <source>Model outputs: {0}</source>
        <translation>Modellausgaben: {0}</translation>
    </message>
    <message>
        <source>Hide all channels</source>
        <translation>Alle Kanäle ausblenden</translation>
    </message>
    <message>
        <source>  or  </source>
        <translation>  oder  </translation>
    </message>
    <message>
        <source>In the plots</source>
        <translation>In den Kurven</translation>
    </message>
    <message>
        <source>Click on an interval</source>
        <translation>Klick auf einen Abschnitt</translation>
    </message>
    <message>
        <source>Select it; double click repairs</source>
        <translation>Auswählen; Doppelklick repariert</translation>
    </message>
    <message>
        <source>Wheel, Ctrl+wheel</source>
        <translation>Rad, Strg+Rad</translation>
    </message>
    <message>
        <source>Zoom time, zoom values</source>
        <translation>Zeit zoomen, Werte zoomen</translation>
    </message>
    <message>
        <source>Middle or right drag</source>
        <translation>Mit mittlerer oder rechter Taste ziehen</translation>
    </message>
    <message>
        <source>Pan</source>
        <translation>Verschieben</translation>
    </message>
    <message>
        <source>Shift+drag</source>
        <translation>Umschalt+Ziehen</translation>
    </message>
    <message>
        <source>Select a range of frames</source>
        <translation>Einen Bereich von Frames auswählen</translation>
    </message>
    <message>
        <source>Drag an edge</source>
        <translation>Eine Kante ziehen</translation>
    </message>
    <message>
        <source>Move the edge of the selected artifact</source>
        <translation>Die Kante des gewählten Artefakts verschieben</translation>
    </message>
    <message>
        <source>In the 3D view</source>
        <translation>In der 3D-Ansicht</translation>
    </message>
    <message>
        <source>Drag</source>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>Orbit</source>
        <translation>Drehen</translation>
    </message>
    <message>
        <source>Middle, right or Shift+drag</source>
        <translation>Mitte, rechts oder Umschalt+Ziehen</translation>
    </message>
    <message>
        <source>Wheel</source>
        <translation>Rad</translation>
    </message>
    <message>
        <source>Zoom</source>
        <translation>Zoomen</translation>
    </message>
    <message>
        <source>Ctrl+drag</source>
        <translation>Strg+Ziehen</translation>
    </message>
    <message>
        <source>Scrub through time</source>
        <translation>Durch die Zeit fahren</translation>
    </message>
    <message>
        <source>Alt+arrows, with Shift</source>
        <translation>Alt+Pfeile, mit Umschalt</translation>
    </message>
    <message>
        <source>Orbit, pan, once the view has the focus</source>
        <translation>Drehen, verschieben, sobald die Ansicht den Fokus hat</translation>
    </message>
    <message>
        <source>+ and −</source>
        <translation>+ und −</translation>
    </message>
    <message>
        <source>Zoom, once the view has the focus</source>
        <translation>Zoomen, sobald die Ansicht den Fokus hat</translation>
    </message>
    <message>
        <source>Keypad 1, 3, 7</source>
        <translation>Ziffernblock 1, 3, 7</translation>
    </message>
    <message>
        <source>Look along an axis, from above</source>
        <translation>Längs einer Achse sehen, von oben</translation>
    </message>
    <message>
        <source>Gap</source>
        <translation>Lücke</translation>
    </message>
    <message>
        <source>Peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Sprung</translation>
    </message>
    <message>
        <source>Slow drift</source>
        <translation>Langsame Drift</translation>
    </message>
    <message>
        <source>gap</source>
        <translation>Lücke</translation>
    </message>
    <message>
        <source>peak</source>
        <translation>Spitze</translation>
    </message>
    <message>
        <source>noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>step</source>
        <translation>Sprung</translation>
    </message>
    <message>
        <source>slow drift</source>
        <translation>langsame Drift</translation>
    </message>
    <message>
        <source>Open take…</source>
        <translation>Aufnahme öffnen…</translation>
    </message>
    <message>
        <source>Open a take</source>
        <translation>Eine Aufnahme öffnen</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>Open the demo take</source>
        <translation>Beispielaufnahme öffnen</translation>
    </message>
    <message>
        <source>It is damaged on purpose: 53 markers, gaps, jumps and noise. File › Open the demo take does the same, and a take of your own will do too.</source>
        <translation>Sie ist mit Absicht beschädigt: 53 Marker, Lücken, Sprünge und Rauschen. Datei › Beispielaufnahme öffnen tut dasselbe, und eine eigene Aufnahme geht auch.</translation>
    </message>
    <message>
        <source>Look at why</source>
        <translation>Sehen, warum</translation>
    </message>
    <message>
        <source>Detection starts by itself; the worst artifact comes first. Here you read what is wrong, how sure that is, and why. Then go on to the next with {0}.</source>
        <translation>Artefakte werden von selbst gesucht; das schlimmste kommt zuerst. Hier steht, was falsch ist, wie sicher das ist und warum. Lesen, dann mit {0} weiter zum nächsten.</translation>
    </message>
    <message>
        <source>Repair it with one key</source>
        <translation>Mit einer Taste reparieren</translation>
    </message>
    <message>
        <source>The thick curve in the plots is the repair that is expected to err least. {0} takes it and moves on; {1} says that the flag is a false alarm.</source>
        <translation>Die dicke Kurve ist die Reparatur, die am wenigsten fehlgehen dürfte. {0} übernimmt sie und geht weiter; {1} heißt, dass der Befund ein Fehlalarm ist.</translation>
    </message>
    <message>
        <source>Take it back</source>
        <translation>Zurücknehmen</translation>
    </message>
    <message>
        <source>Nothing is final, and your file is never changed. Undo the repair with {0}.</source>
        <translation>Nichts ist endgültig, und die Datei wird nie verändert. Die Reparatur mit {0} rückgängig machen.</translation>
    </message>
    <message>
        <source>Compare, or export</source>
        <translation>Vergleichen oder exportieren</translation>
    </message>
    <message>
        <source>Hold {0} to see what every method would do, choose with ↑ and ↓, and let go. Or write a copy with {1}, in which only repaired samples differ.</source>
        <translation>{0} halten, um zu sehen, was jedes Verfahren täte, mit ↑ und ↓ wählen, loslassen. Oder mit {1} eine Kopie schreiben, in der sich nur reparierte Werte unterscheiden.</translation>
    </message>
    <message>
        <source>Review a batch…</source>
        <translation>Eine Serie durchsehen…</translation>
    </message>
    <message>
        <source>List several takes, or what “markermend batch” left, and review one after the other</source>
        <translation>Mehrere Aufnahmen auflisten, oder was „markermend batch“ hinterließ, und eine nach der anderen durchsehen</translation>
    </message>
    <message>
        <source>Review a folder…</source>
        <translation>Einen Ordner durchsehen…</translation>
    </message>
    <message>
        <source>List the takes in a folder and below, and review one after the other</source>
        <translation>Die Aufnahmen eines Ordners und seiner Unterordner auflisten und eine nach der anderen durchsehen</translation>
    </message>
    <message>
        <source>Export repaired take…</source>
        <translation>Reparierte Aufnahme exportieren…</translation>
    </message>
    <message>
        <source>Write a copy in which only repaired samples differ</source>
        <translation>Eine Kopie schreiben, in der sich nur reparierte Werte unterscheiden</translation>
    </message>
    <message>
        <source>Report…</source>
        <translation>Bericht…</translation>
    </message>
    <message>
        <source>Write a page of what was found, decided and repaired, and open it</source>
        <translation>Eine Seite darüber schreiben, was gefunden, entschieden und repariert wurde, und sie öffnen</translation>
    </message>
    <message>
        <source>Joint centres…</source>
        <translation>Gelenkzentren…</translation>
    </message>
    <message>
        <source>Work out where the body&apos;s joints are and how far to trust each, as a skeleton recording</source>
        <translation>Bestimmen, wo die Gelenke des Körpers liegen und wie weit jedem zu trauen ist, als Skelettaufnahme</translation>
    </message>
    <message>
        <source>Close take</source>
        <translation>Aufnahme schließen</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Bearbeiten</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Clear selection</source>
        <translation>Auswahl aufheben</translation>
    </message>
    <message>
        <source>Forget the swept range, or leave choosing and selecting in the 3D view; else go back to the plots</source>
        <translation>Den überstrichenen Bereich vergessen oder das Auswählen in der 3D-Ansicht beenden; sonst zurück zu den Kurven</translation>
    </message>
    <message>
        <source>Find a command, marker or artifact…</source>
        <translation>Befehl, Marker oder Artefakt finden…</translation>
    </message>
    <message>
        <source>Type a few letters to do anything or go anywhere</source>
        <translation>Wenige Buchstaben tippen, um alles zu tun oder überall hinzukommen</translation>
    </message>
    <message>
        <source>Preferences…</source>
        <translation>Einstellungen…</translation>
    </message>
    <message>
        <source>Look, language, units, detection and saving</source>
        <translation>Aussehen, Sprache, Einheiten, Erkennung und Speichern</translation>
    </message>
    <message>
        <source>Detect artifacts</source>
        <translation>Artefakte suchen</translation>
    </message>
    <message>
        <source>Look for gaps, peaks, heavy noise and steps in the whole take</source>
        <translation>In der ganzen Aufnahme nach Lücken, Spitzen, starkem Rauschen und Sprüngen suchen</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Durchsicht</translation>
    </message>
    <message>
        <source>Detect slow drifts too</source>
        <translation>Auch langsame Drift suchen</translation>
    </message>
    <message>
        <source>Look for every class; slow drifts take some seconds longer than all the others</source>
        <translation>Nach allen Arten suchen; langsame Drift dauert einige Sekunden länger als alle anderen</translation>
    </message>
    <message>
        <source>Detect after opening</source>
        <translation>Nach dem Öffnen suchen</translation>
    </message>
    <message>
        <source>Look for gaps, peaks, noise and steps as soon as a take is open</source>
        <translation>Nach Lücken, Spitzen, Rauschen und Sprüngen suchen, sobald eine Aufnahme offen ist</translation>
    </message>
    <message>
        <source>Accept</source>
        <translation>Annehmen</translation>
    </message>
    <message>
        <source>The flag is right; the samples stay for now</source>
        <translation>Der Befund stimmt; die Werte bleiben vorerst</translation>
    </message>
    <message>
        <source>Reject</source>
        <translation>Ablehnen</translation>
    </message>
    <message>
        <source>A false alarm</source>
        <translation>Ein Fehlalarm</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>Replace the samples by the repair shown</source>
        <translation>Die Werte durch die gezeigte Reparatur ersetzen</translation>
    </message>
    <message>
        <source>Repair method 1</source>
        <translation>Reparaturverfahren 1</translation>
    </message>
    <message>
        <source>Preview this repair method for the artifact under review</source>
        <translation>Dieses Verfahren am aktuellen Artefakt vorab zeigen</translation>
    </message>
    <message>
        <source>Repair method</source>
        <translation>Reparaturverfahren</translation>
    </message>
    <message>
        <source>Repair method 2</source>
        <translation>Reparaturverfahren 2</translation>
    </message>
    <message>
        <source>Repair method 3</source>
        <translation>Reparaturverfahren 3</translation>
    </message>
    <message>
        <source>Repair method 4</source>
        <translation>Reparaturverfahren 4</translation>
    </message>
    <message>
        <source>Repair method 5</source>
        <translation>Reparaturverfahren 5</translation>
    </message>
    <message>
        <source>Repair method 6</source>
        <translation>Reparaturverfahren 6</translation>
    </message>
    <message>
        <source>Repair method 7</source>
        <translation>Reparaturverfahren 7</translation>
    </message>
    <message>
        <source>Repair method 8</source>
        <translation>Reparaturverfahren 8</translation>
    </message>
    <message>
        <source>Repair method 9</source>
        <translation>Reparaturverfahren 9</translation>
    </message>
    <message>
        <source>Compare repairs</source>
        <translation>Reparaturen vergleichen</translation>
    </message>
    <message>
        <source>While the key is held, see what every method would do; ↑ and ↓ choose</source>
        <translation>Solange die Taste gedrückt ist, sehen, was jedes Verfahren täte; ↑ und ↓ wählen</translation>
    </message>
    <message>
        <source>Reopen</source>
        <translation>Wieder öffnen</translation>
    </message>
    <message>
        <source>Take the decision back</source>
        <translation>Die Entscheidung zurücknehmen</translation>
    </message>
    <message>
        <source>Remove from the list</source>
        <translation>Aus der Liste entfernen</translation>
    </message>
    <message>
        <source>Repair all accepted</source>
        <translation>Alle angenommenen reparieren</translation>
    </message>
    <message>
        <source>Repair every accepted artifact with its best method, as one step</source>
        <translation>Jedes angenommene Artefakt mit seinem besten Verfahren reparieren, als ein Schritt</translation>
    </message>
    <message>
        <source>Repair all like this…</source>
        <translation>Alle ähnlichen reparieren…</translation>
    </message>
    <message>
        <source>List the open artifacts of its class, and repair them in one step</source>
        <translation>Die offenen Artefakte derselben Art auflisten und in einem Schritt reparieren</translation>
    </message>
    <message>
        <source>Reject all like this…</source>
        <translation>Alle ähnlichen ablehnen…</translation>
    </message>
    <message>
        <source>List the open artifacts of its class, and reject them in one step</source>
        <translation>Die offenen Artefakte derselben Art auflisten und in einem Schritt ablehnen</translation>
    </message>
    <message>
        <source>Lower what was rejected several times</source>
        <translation>Mehrfach Abgelehntes zurückstufen</translation>
    </message>
    <message>
        <source>Answer yes when asked whether the rest of a sort is to come last</source>
        <translation>Ja sagen auf die Frage, ob der Rest dieser Sorte ans Ende soll</translation>
    </message>
    <message>
        <source>Previous artifact</source>
        <translation>Voriges Artefakt</translation>
    </message>
    <message>
        <source>Next artifact</source>
        <translation>Nächstes Artefakt</translation>
    </message>
    <message>
        <source>Next take</source>
        <translation>Nächste Aufnahme</translation>
    </message>
    <message>
        <source>Keep this review and open the next take of the list that is not done</source>
        <translation>Diese Durchsicht behalten und die nächste Aufnahme der Liste öffnen, die nicht fertig ist</translation>
    </message>
    <message>
        <source>Write a note</source>
        <translation>Notiz schreiben</translation>
    </message>
    <message>
        <source>Say something about it</source>
        <translation>Etwas dazu sagen</translation>
    </message>
    <message>
        <source>Begin or end a selection at the cursor</source>
        <translation>Auswahl am Cursor beginnen oder beenden</translation>
    </message>
    <message>
        <source>Select from here to where the cursor is when it is pressed again, without the mouse</source>
        <translation>Ohne Maus von hier bis dorthin auswählen, wo der Cursor beim nächsten Druck steht</translation>
    </message>
    <message>
        <source>Mark selection</source>
        <translation>Auswahl kennzeichnen</translation>
    </message>
    <message>
        <source>Make an artifact of the swept range</source>
        <translation>Aus dem überstrichenen Bereich ein Artefakt machen</translation>
    </message>
    <message>
        <source>By hand</source>
        <translation>Von Hand</translation>
    </message>
    <message>
        <source>Filter the list</source>
        <translation>Liste filtern</translation>
    </message>
    <message>
        <source>Narrow down the markers, or the review queue while the keyboard is there</source>
        <translation>Die Marker eingrenzen, oder die Prüfliste, solange die Tastatur dort ist</translation>
    </message>
    <message>
        <source>Repair selection</source>
        <translation>Auswahl reparieren</translation>
    </message>
    <message>
        <source>Replace the swept range of the marker by the best repair</source>
        <translation>Den überstrichenen Bereich des Markers durch die beste Reparatur ersetzen</translation>
    </message>
    <message>
        <source>Smooth…</source>
        <translation>Glätten…</translation>
    </message>
    <message>
        <source>Take the noise out of the swept range, a marker, its group or the take, seen before</source>
        <translation>Das Rauschen aus dem überstrichenen Bereich, einem Marker, seiner Gruppe oder der Aufnahme nehmen, mit Vorschau</translation>
    </message>
    <message>
        <source>Cut selection</source>
        <translation>Auswahl ausschneiden</translation>
    </message>
    <message>
        <source>Make the swept range missing; the gap comes under review</source>
        <translation>Den überstrichenen Bereich entfernen; die Lücke kommt in die Durchsicht</translation>
    </message>
    <message>
        <source>Swap selection with another marker…</source>
        <translation>Auswahl mit anderem Marker tauschen…</translation>
    </message>
    <message>
        <source>Exchange the swept range with that of another marker, from here to there</source>
        <translation>Den überstrichenen Bereich mit dem eines anderen Markers tauschen, von hier bis dort</translation>
    </message>
    <message>
        <source>Give selection to another marker…</source>
        <translation>Auswahl einem anderen Marker geben…</translation>
    </message>
    <message>
        <source>The swept range has the wrong name: it becomes part of another marker</source>
        <translation>Der überstrichene Bereich trägt den falschen Namen: Er wird Teil eines anderen Markers</translation>
    </message>
    <message>
        <source>Rename marker…</source>
        <translation>Marker umbenennen…</translation>
    </message>
    <message>
        <source>Give the foremost marker another name in the whole take</source>
        <translation>Dem vordersten Marker in der ganzen Aufnahme einen anderen Namen geben</translation>
    </message>
    <message>
        <source>Merge marker…</source>
        <translation>Marker zusammenführen…</translation>
    </message>
    <message>
        <source>Take an unlabelled trajectory into the foremost marker, or give all of it to another one</source>
        <translation>Eine unbenannte Trajektorie in den vordersten Marker aufnehmen oder ihn ganz einem anderen geben</translation>
    </message>
    <message>
        <source>Choose the markers to follow</source>
        <translation>Marker wählen, denen gefolgt wird</translation>
    </message>
    <message>
        <source>Click markers in the 3D view, or press Return on them in the tree; the repair follows these only</source>
        <translation>Marker in der 3D-Ansicht anklicken oder im Baum die Eingabetaste auf ihnen drücken; die Reparatur folgt nur diesen</translation>
    </message>
    <message>
        <source>Split artifact at the cursor</source>
        <translation>Artefakt am Cursor teilen</translation>
    </message>
    <message>
        <source>Make two artifacts of the one under review</source>
        <translation>Aus dem aktuellen Artefakt zwei machen</translation>
    </message>
    <message>
        <source>Join artifacts</source>
        <translation>Artefakte verbinden</translation>
    </message>
    <message>
        <source>Make one of those selected in the queue, else of this one and the next on its marker</source>
        <translation>Aus den in der Prüfliste gewählten eines machen, sonst aus diesem und dem nächsten an seinem Marker</translation>
    </message>
    <message>
        <source>Begin one frame earlier</source>
        <translation>Einen Frame früher beginnen</translation>
    </message>
    <message>
        <source>Edges</source>
        <translation>Kanten</translation>
    </message>
    <message>
        <source>Begin one frame later</source>
        <translation>Einen Frame später beginnen</translation>
    </message>
    <message>
        <source>End one frame earlier</source>
        <translation>Einen Frame früher enden</translation>
    </message>
    <message>
        <source>End one frame later</source>
        <translation>Einen Frame später enden</translation>
    </message>
    <message>
        <source>Call the artifact under review this</source>
        <translation>Das aktuelle Artefakt so nennen</translation>
    </message>
    <message>
        <source>Play or pause</source>
        <translation>Abspielen oder anhalten</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>One frame forward</source>
        <translation>Einen Frame vor</translation>
    </message>
    <message>
        <source>One frame back</source>
        <translation>Einen Frame zurück</translation>
    </message>
    <message>
        <source>Ten frames forward</source>
        <translation>Zehn Frames vor</translation>
    </message>
    <message>
        <source>Ten frames back</source>
        <translation>Zehn Frames zurück</translation>
    </message>
    <message>
        <source>To the first frame</source>
        <translation>Zum ersten Frame</translation>
    </message>
    <message>
        <source>To the last frame</source>
        <translation>Zum letzten Frame</translation>
    </message>
    <message>
        <source>Region of interest begins here</source>
        <translation>Ausschnitt beginnt hier</translation>
    </message>
    <message>
        <source>What lies before the cursor is not asked about, and can be left out of the export</source>
        <translation>Nach dem, was vor dem Zeiger liegt, wird nicht gefragt; der Export kann es weglassen</translation>
    </message>
    <message>
        <source>Region of interest ends here</source>
        <translation>Ausschnitt endet hier</translation>
    </message>
    <message>
        <source>What lies after the cursor is not asked about, and can be left out of the export</source>
        <translation>Nach dem, was hinter dem Zeiger liegt, wird nicht gefragt; der Export kann es weglassen</translation>
    </message>
    <message>
        <source>Review the selection only</source>
        <translation>Nur die Auswahl durchsehen</translation>
    </message>
    <message>
        <source>Make the swept range the region of interest</source>
        <translation>Die überstrichenen Frames zum Ausschnitt machen</translation>
    </message>
    <message>
        <source>Review the whole take</source>
        <translation>Die ganze Aufnahme durchsehen</translation>
    </message>
    <message>
        <source>Forget the region of interest</source>
        <translation>Den Ausschnitt vergessen</translation>
    </message>
    <message>
        <source>Show the whole take</source>
        <translation>Ganze Aufnahme zeigen</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation>Vergrößern</translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation>Verkleinern</translation>
    </message>
    <message>
        <source>Show the samples before repair</source>
        <translation>Werte vor der Reparatur zeigen</translation>
    </message>
    <message>
        <source>Swap the curves before and after repair</source>
        <translation>Zwischen den Kurven vor und nach der Reparatur wechseln</translation>
    </message>
    <message>
        <source>Show the body&apos;s prediction</source>
        <translation>Vorhersage des Körpers zeigen</translation>
    </message>
    <message>
        <source>Where the rest of the body says the marker should be</source>
        <translation>Wo der Marker nach dem übrigen Körper sein müsste</translation>
    </message>
    <message>
        <source>Change the overview</source>
        <translation>Übersicht wechseln</translation>
    </message>
    <message>
        <source>Overview of damage, of gaps, or of distances to the body&apos;s prediction</source>
        <translation>Übersicht der Schäden, der Lücken oder der Abstände zur Vorhersage des Körpers</translation>
    </message>
    <message>
        <source>Choose plots…</source>
        <translation>Kurven wählen…</translation>
    </message>
    <message>
        <source>Choose what the plots show</source>
        <translation>Wählen, was die Kurven zeigen</translation>
    </message>
    <message>
        <source>Next panel</source>
        <translation>Nächster Bereich</translation>
    </message>
    <message>
        <source>Give the keyboard to the next panel; Esc gives it back to the plots</source>
        <translation>Die Tastatur dem nächsten Bereich geben; Esc gibt sie den Kurven zurück</translation>
    </message>
    <message>
        <source>Previous panel</source>
        <translation>Vorheriger Bereich</translation>
    </message>
    <message>
        <source>Give the keyboard to the previous panel</source>
        <translation>Die Tastatur dem vorherigen Bereich geben</translation>
    </message>
    <message>
        <source>Light theme</source>
        <translation>Helles Aussehen</translation>
    </message>
    <message>
        <source>Dark theme</source>
        <translation>Dunkles Aussehen</translation>
    </message>
    <message>
        <source>High contrast theme</source>
        <translation>Hoher Kontrast</translation>
    </message>
    <message>
        <source>Theme of the system</source>
        <translation>Aussehen des Systems</translation>
    </message>
    <message>
        <source>Reset the layout</source>
        <translation>Anordnung zurücksetzen</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>The page about the panel in use</source>
        <translation>Die Seite zum gerade benutzten Bereich</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Tour in five steps</source>
        <translation>Rundgang in fünf Schritten</translation>
    </message>
    <message>
        <source>From a damaged take to a repaired one, on the demo take</source>
        <translation>Von einer beschädigten zu einer reparierten Aufnahme, an der Beispielaufnahme</translation>
    </message>
    <message>
        <source>Keyboard and mouse…</source>
        <translation>Tastatur und Maus…</translation>
    </message>
    <message>
        <source>Keyboard and mouse</source>
        <translation>Tastatur und Maus</translation>
    </message>
    <message>
        <source>Find a command, joint or artifact…</source>
        <translation>Befehl, Gelenk oder Artefakt finden…</translation>
    </message>
    <message>
        <source>Narrow down the joints, or the review queue while the keyboard is there</source>
        <translation>Die Gelenke eingrenzen, oder die Prüfliste, solange die Tastatur dort ist</translation>
    </message>
    <message>
        <source>Look for joints that are missing, frozen, away or on the other side</source>
        <translation>Nach Gelenken suchen, die fehlen, stillstehen, woanders oder auf der anderen Seite sind</translation>
    </message>
    <message>
        <source>Only for takes of markers: “Detect artifacts” looks for all that is known of joints</source>
        <translation>Nur für Aufnahmen von Markern: „Artefakte suchen“ sucht nach allem, was von Gelenken bekannt ist</translation>
    </message>
    <message>
        <source>Only for takes of markers: a skeleton recording has its joints in it already</source>
        <translation>Nur für Aufnahmen von Markern: Eine Skelettaufnahme enthält ihre Gelenke schon</translation>
    </message>
    <message>
        <source>Where the rest of the body says the joint should be</source>
        <translation>Wo das Gelenk nach dem übrigen Körper sein müsste</translation>
    </message>
    <message>
        <source>Replace the swept range of the joint by the best repair</source>
        <translation>Den überstrichenen Bereich des Gelenks durch die beste Reparatur ersetzen</translation>
    </message>
    <message>
        <source>Take the noise out of the swept range, a joint, its group or the take, seen before</source>
        <translation>Das Rauschen aus dem überstrichenen Bereich, einem Gelenk, seiner Gruppe oder der Aufnahme nehmen, mit Vorschau</translation>
    </message>
    <message>
        <source>Swap selection with another joint…</source>
        <translation>Auswahl mit anderem Gelenk tauschen…</translation>
    </message>
    <message>
        <source>Exchange the swept range with that of another joint, from here to there</source>
        <translation>Den überstrichenen Bereich mit dem eines anderen Gelenks tauschen, von hier bis dort</translation>
    </message>
    <message>
        <source>Give selection to another joint…</source>
        <translation>Auswahl einem anderen Gelenk geben…</translation>
    </message>
    <message>
        <source>The swept range has the wrong name: it becomes part of another joint</source>
        <translation>Der überstrichene Bereich hat den falschen Namen: Er wird Teil eines anderen Gelenks</translation>
    </message>
    <message>
        <source>Rename joint…</source>
        <translation>Gelenk umbenennen…</translation>
    </message>
    <message>
        <source>Give the foremost joint another name in the whole take</source>
        <translation>Dem vordersten Gelenk in der ganzen Aufnahme einen anderen Namen geben</translation>
    </message>
    <message>
        <source>Merge joint…</source>
        <translation>Gelenk zusammenführen…</translation>
    </message>
    <message>
        <source>Give all of the foremost joint to another one that is missing there</source>
        <translation>Das ganze vorderste Gelenk einem anderen geben, das dort fehlt</translation>
    </message>
    <message>
        <source>Choose the joints to follow</source>
        <translation>Gelenke wählen, denen gefolgt wird</translation>
    </message>
    <message>
        <source>Click joints in the 3D view, or press Return on them in the tree; the repair follows these only</source>
        <translation>Gelenke in der 3D-Ansicht anklicken oder im Baum die Eingabetaste auf ihnen drücken; die Reparatur folgt nur diesen</translation>
    </message>
    <message>
        <source>Make one of those selected in the queue, else of this one and the next on its joint</source>
        <translation>Aus den in der Prüfliste gewählten eines machen, sonst aus diesem und dem nächsten an seinem Gelenk</translation>
    </message>
    <message>
        <source>Long short-term memory in both directions predict the joint from its parent and siblings; trains for seconds.</source>
        <translation>Langes Kurzzeitgedächtnis in beiden Richtungen sagt das Gelenk aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>DynaMMo held softly to the distances that joints of a segment keep.</source>
        <translation>DynaMMo, sanft an die Abstände gebunden, die Gelenke eines Segments halten.</translation>
    </message>
    <message>
        <source>A network of 8 linear neurons predicts the joint from its parent and siblings.</source>
        <translation>Ein Netz aus 8 linearen Neuronen sagt das Gelenk aus Eltern und Geschwistern vorher.</translation>
    </message>
    <message>
        <source>A small network trained on this take predicts the joint from its body; slow.</source>
        <translation>Ein kleines, an dieser Aufnahme gelerntes Netz sagt das Gelenk aus seinem Körper vorher; langsam.</translation>
    </message>
    <message>
        <source>A network of 8 tanh neurons predicts the joint from its parent and siblings.</source>
        <translation>Ein Netz aus 8 Tanh-Neuronen sagt das Gelenk aus Eltern und Geschwistern vorher.</translation>
    </message>
    <message>
        <source>Least squares on all joints whose distance varies little.</source>
        <translation>Kleinste Quadrate über alle Gelenke, deren Abstand wenig schwankt.</translation>
    </message>
    <message>
        <source>60 gated recurrent neurons predict the joint from its parent and siblings; trains for seconds.</source>
        <translation>60 rückgekoppelte Neuronen mit Toren sagen das Gelenk aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>60 long short-term memory neurons predict the joint from its parent and siblings; trains for seconds.</source>
        <translation>60 Neuronen mit langem Kurzzeitgedächtnis sagen das Gelenk aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>Completes the matrix of all joints by its main components; for long intervals.</source>
        <translation>Ergänzt die Matrix aller Gelenke durch ihre Hauptkomponenten; für lange Abschnitte.</translation>
    </message>
    <message>
        <source>Follows one other joint and joins both borders; for joints that move alike.</source>
        <translation>Folgt einem anderen Gelenk und schließt an beiden Rändern an; für Gelenke, die sich ähnlich bewegen.</translation>
    </message>
    <message>
        <source>Rebuilds the joint from the main components of the others.</source>
        <translation>Stellt das Gelenk aus den Hauptkomponenten der übrigen wieder her.</translation>
    </message>
    <message>
        <source>Moves the joint with three or more others of its group; for rigid segments.</source>
        <translation>Bewegt das Gelenk mit drei oder mehr anderen seiner Gruppe; für starre Segmente.</translation>
    </message>
    <message>
        <source>Gives the joint and its counterpart their own samples back; nothing is invented.</source>
        <translation>Gibt dem Gelenk und seinem Gegenstück ihre eigenen Werte zurück; nichts wird erfunden.</translation>
    </message>
    <message>
        <source>load import read file c3d trc csv bvh amc</source>
        <translation>laden importieren lesen Datei c3d trc csv bvh amc</translation>
    </message>
    <message>
        <source>queue takes multiple pipeline</source>
        <translation>Stapel Aufnahmen mehrere Pipeline</translation>
    </message>
    <message>
        <source>directory takes multiple pipeline</source>
        <translation>Verzeichnis Aufnahmen mehrere Pipeline</translation>
    </message>
    <message>
        <source>example sample tutorial</source>
        <translation>Demo Muster Probe</translation>
    </message>
    <message>
        <source>save write file c3d trc csv copy as</source>
        <translation>speichern schreiben Datei sichern c3d trc csv Kopie</translation>
    </message>
    <message>
        <source>html quality statistics summary print</source>
        <translation>html Qualität Statistik Zusammenfassung drucken</translation>
    </message>
    <message>
        <source>centre of rotation hip knee elbow shoulder functional score skeleton pose kinematics bones csv</source>
        <translation>Drehzentrum Drehpunkt Hüfte Knie Ellbogen Schulter funktionell Skelett Pose Kinematik Knochen csv</translation>
    </message>
    <message>
        <source>discard unload</source>
        <translation>verwerfen entladen zumachen</translation>
    </message>
    <message>
        <source>exit leave</source>
        <translation>verlassen schließen Ende</translation>
    </message>
    <message>
        <source>back revert history</source>
        <translation>zurück zurücknehmen Verlauf undo</translation>
    </message>
    <message>
        <source>again forward history</source>
        <translation>erneut vor Verlauf redo</translation>
    </message>
    <message>
        <source>deselect escape cancel</source>
        <translation>abwählen Escape abbrechen</translation>
    </message>
    <message>
        <source>search find narrow</source>
        <translation>suchen finden eingrenzen</translation>
    </message>
    <message>
        <source>settings options configure units millimetres language theme dark colours axis autosave threads processes sensitivity preset shortcuts</source>
        <translation>Optionen Konfiguration Einheiten Millimeter Sprache Aussehen dunkel Farben Achse automatisch speichern Threads Prozesse Empfindlichkeit Vorlage Tasten</translation>
    </message>
    <message>
        <source>find analyse scan check errors problems gaps spikes</source>
        <translation>finden analysieren prüfen Fehler Probleme Lücken Spitzen suchen</translation>
    </message>
    <message>
        <source>drift creep slide slippage</source>
        <translation>Drift kriechen rutschen</translation>
    </message>
    <message>
        <source>confirm keep yes</source>
        <translation>bestätigen behalten ja</translation>
    </message>
    <message>
        <source>ignore false alarm dismiss no</source>
        <translation>ignorieren Fehlalarm verwerfen nein</translation>
    </message>
    <message>
        <source>fill gap fix interpolate spline pattern rigid body apply</source>
        <translation>füllen Lücke beheben interpolieren Spline Starrkörper anwenden</translation>
    </message>
    <message>
        <source>candidates methods alternatives</source>
        <translation>Kandidaten Verfahren Alternativen</translation>
    </message>
    <message>
        <source>reset undecide pending</source>
        <translation>zurücksetzen offen unentschieden</translation>
    </message>
    <message>
        <source>delete dismiss</source>
        <translation>löschen verwerfen</translation>
    </message>
    <message>
        <source>fill gaps fix batch all</source>
        <translation>Lücken füllen beheben Stapel alle</translation>
    </message>
    <message>
        <source>fill gaps fix all similar same</source>
        <translation>Lücken füllen beheben alle ähnlichen gleichen</translation>
    </message>
    <message>
        <source>ignore all similar same false alarms</source>
        <translation>ignorieren alle ähnlichen gleichen Fehlalarme</translation>
    </message>
    <message>
        <source>back gap problem last</source>
        <translation>zurück Lücke Problem letztes</translation>
    </message>
    <message>
        <source>forward gap problem jump</source>
        <translation>vor Lücke Problem springen</translation>
    </message>
    <message>
        <source>comment annotate remark text</source>
        <translation>Kommentar Anmerkung Bemerkung Text</translation>
    </message>
    <message>
        <source>select range region interval</source>
        <translation>auswählen Bereich Intervall</translation>
    </message>
    <message>
        <source>flag label artifact gap range</source>
        <translation>markieren Artefakt Lücke Bereich</translation>
    </message>
    <message>
        <source>fill gap fix interpolate range</source>
        <translation>füllen Lücke beheben interpolieren Bereich</translation>
    </message>
    <message>
        <source>filter butterworth spline kalman savitzky golay low-pass denoise jitter</source>
        <translation>Filter Butterworth Spline Kalman Savitzky Golay Tiefpass entrauschen Zittern</translation>
    </message>
    <message>
        <source>delete erase crop samples unlabel hide</source>
        <translation>löschen entfernen Werte ausblenden</translation>
    </message>
    <message>
        <source>exchange switch flip markers labels</source>
        <translation>austauschen wechseln Marker Namen</translation>
    </message>
    <message>
        <source>relabel assign reassign trajectory labels</source>
        <translation>umbenennen zuordnen Trajektorie Namen</translation>
    </message>
    <message>
        <source>label relabel name</source>
        <translation>benennen beschriften Name</translation>
    </message>
    <message>
        <source>join stitch combine unlabelled trajectory fragment label identify</source>
        <translation>verbinden vereinen namenlose Trajektorie Stück zuordnen</translation>
    </message>
    <message>
        <source>donor source pattern rigid body cluster</source>
        <translation>Spender Quelle Muster Starrkörper Cluster</translation>
    </message>
    <message>
        <source>divide cut</source>
        <translation>aufteilen schneiden</translation>
    </message>
    <message>
        <source>merge combine</source>
        <translation>vereinen zusammenführen</translation>
    </message>
    <message>
        <source>playback run stop video animate</source>
        <translation>Wiedergabe starten anhalten Video</translation>
    </message>
    <message>
        <source>rewind beginning first</source>
        <translation>zurückspulen Anfang erster</translation>
    </message>
    <message>
        <source>last finish</source>
        <translation>letzter Ende Schluss</translation>
    </message>
    <message>
        <source>roi crop trim in point range frames</source>
        <translation>roi beschneiden zuschneiden anfang bereich frames</translation>
    </message>
    <message>
        <source>roi crop trim out point range frames</source>
        <translation>roi beschneiden zuschneiden ende bereich frames</translation>
    </message>
    <message>
        <source>roi crop trim region of interest range frames</source>
        <translation>roi beschneiden zuschneiden bereich frames</translation>
    </message>
    <message>
        <source>roi crop trim region of interest reset all frames</source>
        <translation>roi beschneiden zuschneiden bereich zurücksetzen alle frames</translation>
    </message>
    <message>
        <source>zoom all full reset frame home</source>
        <translation>Zoom alles ganz zurücksetzen einpassen</translation>
    </message>
    <message>
        <source>original raw source compare ghost</source>
        <translation>Original roh Quelle vergleichen Geist</translation>
    </message>
    <message>
        <source>model expected body rigid</source>
        <translation>Modell erwartet Körper starr</translation>
    </message>
    <message>
        <source>heat map gaps damage residual timeline</source>
        <translation>Wärmekarte Lücken Schäden Residuum Zeitleiste</translation>
    </message>
    <message>
        <source>graph curves analog force plates emg channels speed velocity acceleration residual cameras distance events</source>
        <translation>Graph Kurven analog Kraft Kraftmessplatten EMG Kanäle Tempo Geschwindigkeit Beschleunigung Residuum Kameras Abstand Ereignisse</translation>
    </message>
    <message>
        <source>bright white appearance</source>
        <translation>weiß Aussehen Design</translation>
    </message>
    <message>
        <source>night black mode appearance</source>
        <translation>Nacht schwarz Modus Aussehen Design</translation>
    </message>
    <message>
        <source>accessibility appearance</source>
        <translation>Barrierefreiheit Aussehen Design</translation>
    </message>
    <message>
        <source>automatic appearance</source>
        <translation>automatisch Aussehen Design</translation>
    </message>
    <message>
        <source>panels docks windows default restore arrange</source>
        <translation>Bereiche Fenster Standard wiederherstellen anordnen</translation>
    </message>
    <message>
        <source>help documentation guide handbook</source>
        <translation>Hilfe Dokumentation Anleitung</translation>
    </message>
    <message>
        <source>tutorial introduction getting started guide help</source>
        <translation>Tutorial Einführung Anfang Anleitung Hilfe</translation>
    </message>
    <message>
        <source>hotkeys keys bindings cheat sheet nexus qtm motive customise preset</source>
        <translation>Tastenkürzel Belegung Spickzettel Nexus QTM Motive anpassen Vorlage</translation>
    </message>
    <message>
        <source>version licence</source>
        <translation>Version Lizenz</translation>
    </message>
    <message>
        <source>Local regression</source>
        <translation>Örtliche Regression</translation>
    </message>
    <message>
        <source>Follows the body around it and joins its own way in and out; the usual choice.</source>
        <translation>Folgt dem Körper ringsum und schließt an den eigenen Weg davor und danach an; die übliche Wahl.</translation>
    </message>
    <message>
        <source>Cubic spline</source>
        <translation>Kubischer Spline</translation>
    </message>
    <message>
        <source>Smooth curve of continuous acceleration; best for peaks and up to about 0.1 s.</source>
        <translation>Glatte Kurve mit stetiger Beschleunigung; am besten für Spitzen und bis etwa 0,1 s.</translation>
    </message>
    <message>
        <source>PCHIP</source>
        <translation>PCHIP</translation>
    </message>
    <message>
        <source>Piecewise cubic that never overshoots; safer than the spline over longer intervals.</source>
        <translation>Stückweise kubisch, schwingt nie über; über längere Abschnitte sicherer als der Spline.</translation>
    </message>
    <message>
        <source>Modified Akima</source>
        <translation>Akima, abgewandelt</translation>
    </message>
    <message>
        <source>Piecewise cubic between spline and PCHIP: smooth, with little overshoot.</source>
        <translation>Stückweise kubisch zwischen Spline und PCHIP: glatt, mit wenig Überschwingen.</translation>
    </message>
    <message>
        <source>Straight line</source>
        <translation>Gerade</translation>
    </message>
    <message>
        <source>Joins the last good sample before and the first after; for the shortest intervals.</source>
        <translation>Verbindet den letzten guten Wert davor mit dem ersten danach; für die kürzesten Abschnitte.</translation>
    </message>
    <message>
        <source>Swap markers</source>
        <translation>Marker tauschen</translation>
    </message>
    <message>
        <source>Gives the marker and its counterparts their own samples back; nothing is invented.</source>
        <translation>Gibt dem Marker und seinen Gegenstücken ihre eigenen Werte zurück; nichts wird erfunden.</translation>
    </message>
    <message>
        <source>Savitzky–Golay</source>
        <translation>Savitzky–Golay</translation>
    </message>
    <message>
        <source>Smooths the damaged samples themselves; for noise that still holds the movement.</source>
        <translation>Glättet die beschädigten Werte selbst; für Rauschen, in dem die Bewegung noch steckt.</translation>
    </message>
    <message>
        <source>Loose network</source>
        <translation>Loses Netz</translation>
    </message>
    <message>
        <source>A small network trained on this take predicts the marker from its body; slow.</source>
        <translation>Ein kleines, an dieser Aufnahme gelerntes Netz sagt den Marker aus seinem Körper vorher; langsam.</translation>
    </message>
    <message>
        <source>Leave empty</source>
        <translation>Leer lassen</translation>
    </message>
    <message>
        <source>Removes the wrong samples and leaves a gap, where no honest repair exists.</source>
        <translation>Entfernt die falschen Werte und lässt eine Lücke, wo es keine redliche Reparatur gibt.</translation>
    </message>
    <message>
        <source>BiLSTM</source>
        <translation>BiLSTM</translation>
    </message>
    <message>
        <source>Long short-term memory in both directions predict the marker from its parent and siblings; trains for seconds.</source>
        <translation>Langes Kurzzeitgedächtnis in beiden Richtungen sagt den Marker aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>BoLeRO</source>
        <translation>BoLeRO</translation>
    </message>
    <message>
        <source>DynaMMo held softly to the distances that markers of a segment keep.</source>
        <translation>DynaMMo, sanft an die Abstände gebunden, die Marker eines Segments halten.</translation>
    </message>
    <message>
        <source>Cyclic</source>
        <translation>Zyklisch</translation>
    </message>
    <message>
        <source>Copies the same movement from elsewhere in the take; for gait and other repetitions.</source>
        <translation>Übernimmt dieselbe Bewegung von anderswo in der Aufnahme; für Gang und andere Wiederholungen.</translation>
    </message>
    <message>
        <source>DynaMMo</source>
        <translation>DynaMMo</translation>
    </message>
    <message>
        <source>One hidden movement of the whole body; crosses intervals in which nothing is seen.</source>
        <translation>Eine verborgene Bewegung des ganzen Körpers; überbrückt Abschnitte, in denen nichts zu sehen ist.</translation>
    </message>
    <message>
        <source>Linear network</source>
        <translation>Lineares Netz</translation>
    </message>
    <message>
        <source>A network of 8 linear neurons predicts the marker from its parent and siblings.</source>
        <translation>Ein Netz aus 8 linearen Neuronen sagt den Marker aus Eltern und Geschwistern vorher.</translation>
    </message>
    <message>
        <source>Tanh network</source>
        <translation>Tanh-Netz</translation>
    </message>
    <message>
        <source>A network of 8 tanh neurons predicts the marker from its parent and siblings.</source>
        <translation>Ein Netz aus 8 Tanh-Neuronen sagt den Marker aus Eltern und Geschwistern vorher.</translation>
    </message>
    <message>
        <source>Global linear regression</source>
        <translation>Globale lineare Regression</translation>
    </message>
    <message>
        <source>Least squares on all markers whose distance varies little.</source>
        <translation>Kleinste Quadrate über alle Marker, deren Abstand wenig schwankt.</translation>
    </message>
    <message>
        <source>GRU</source>
        <translation>GRU</translation>
    </message>
    <message>
        <source>60 gated recurrent neurons predict the marker from its parent and siblings; trains for seconds.</source>
        <translation>60 rückgekoppelte Neuronen mit Toren sagen den Marker aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>Kalman smoother</source>
        <translation>Kalman-Glätter</translation>
    </message>
    <message>
        <source>Moves on under constant acceleration from both sides; for short intervals, with band.</source>
        <translation>Geht von beiden Seiten mit konstanter Beschleunigung weiter; für kurze Abschnitte, mit Band.</translation>
    </message>
    <message>
        <source>Local GRNN</source>
        <translation>Örtliches GRNN</translation>
    </message>
    <message>
        <source>Average of similar poses of three references in their own system.</source>
        <translation>Mittel ähnlicher Haltungen dreier Bezugsmarker in deren eigenem System.</translation>
    </message>
    <message>
        <source>Local interpolation</source>
        <translation>Örtliche Interpolation</translation>
    </message>
    <message>
        <source>A straight line in a system of three references.</source>
        <translation>Eine Gerade im System dreier Bezugsmarker.</translation>
    </message>
    <message>
        <source>Local polynomial regression</source>
        <translation>Örtliche polynomiale Regression</translation>
    </message>
    <message>
        <source>Quadratic regression on three references in their own system.</source>
        <translation>Quadratische Regression auf drei Bezugsmarker in deren eigenem System.</translation>
    </message>
    <message>
        <source>LSTM</source>
        <translation>LSTM</translation>
    </message>
    <message>
        <source>60 long short-term memory neurons predict the marker from its parent and siblings; trains for seconds.</source>
        <translation>60 Neuronen mit langem Kurzzeitgedächtnis sagen den Marker aus Eltern und Geschwistern vorher; lernt einige Sekunden.</translation>
    </message>
    <message>
        <source>Low rank</source>
        <translation>Niedriger Rang</translation>
    </message>
    <message>
        <source>Completes the matrix of all markers by its main components; for long intervals.</source>
        <translation>Ergänzt die Matrix aller Marker durch ihre Hauptkomponenten; für lange Abschnitte.</translation>
    </message>
    <message>
        <source>Pattern</source>
        <translation>Muster</translation>
    </message>
    <message>
        <source>Follows one other marker and joins both borders; for markers that move alike.</source>
        <translation>Folgt einem anderen Marker und schließt an beiden Rändern an; für Marker, die sich ähnlich bewegen.</translation>
    </message>
    <message>
        <source>Weighted PCA</source>
        <translation>Gewichtete PCA</translation>
    </message>
    <message>
        <source>Rebuilds the marker from the main components of the others.</source>
        <translation>Stellt den Marker aus den Hauptkomponenten der übrigen wieder her.</translation>
    </message>
    <message>
        <source>Model averaging</source>
        <translation>Modellmittelung</translation>
    </message>
    <message>
        <source>Averages local polynomial, local GRNN, global linear and PCA by likely distances.</source>
        <translation>Mittelt örtliches Polynom, örtliches GRNN, globale Regression und PCA nach wahrscheinlichen Abständen.</translation>
    </message>
    <message>
        <source>Model averaging, all models</source>
        <translation>Modellmittelung, alle Modelle</translation>
    </message>
    <message>
        <source>Averages all five models by likely distances.</source>
        <translation>Mittelt alle fünf Modelle nach wahrscheinlichen Abständen.</translation>
    </message>
    <message>
        <source>Model averaging without PCA</source>
        <translation>Modellmittelung ohne PCA</translation>
    </message>
    <message>
        <source>Averages all models but PCA by likely distances.</source>
        <translation>Mittelt alle Modelle außer PCA nach wahrscheinlichen Abständen.</translation>
    </message>
    <message>
        <source>Rigid body</source>
        <translation>Starrer Körper</translation>
    </message>
    <message>
        <source>Moves the marker with three or more others of its group; for rigid segments.</source>
        <translation>Bewegt den Marker mit drei oder mehr anderen seiner Gruppe; für starre Segmente.</translation>
    </message>
    <message>
        <source>Restore skeleton</source>
        <translation>Skelett wiederherstellen</translation>
    </message>
    <message>
        <source>Adaptive</source>
        <translation>Anpassend</translation>
    </message>
    <message>
        <source>Estimates noise and liveliness at each moment; a kick keeps its peak, standing still loses its jitter.</source>
        <translation>Schätzt Rauschen und Lebhaftigkeit in jedem Augenblick; ein Tritt behält seine Spitze, Stillstand verliert sein Zittern.</translation>
    </message>
    <message>
        <source>B-spline</source>
        <translation>B-Spline</translation>
    </message>
    <message>
        <source>Least-squares curve of few control points; derivatives are continuous.</source>
        <translation>Kurve aus wenigen Kontrollpunkten nach kleinsten Quadraten; Ableitungen sind stetig.</translation>
    </message>
    <message>
        <source>Butterworth</source>
        <translation>Butterworth</translation>
    </message>
    <message>
        <source>Low pass run forwards and backwards; one cut-off for calm and fast alike.</source>
        <translation>Tiefpass vorwärts und rückwärts; eine Grenzfrequenz für Ruhiges und Schnelles.</translation>
    </message>
    <message>
        <source>Kalman filter</source>
        <translation>Kalman-Filter</translation>
    </message>
    <message>
        <source>Runs along the signal once, so that it lags; as published, for comparison.</source>
        <translation>Läuft einmal am Signal entlang und hinkt daher nach; wie veröffentlicht, zum Vergleich.</translation>
    </message>
    <message>
        <source>Moving average</source>
        <translation>Gleitender Mittelwert</translation>
    </message>
    <message>
        <source>Mean of the neighbouring frames; leaves much noise in the derivatives.</source>
        <translation>Mittel der benachbarten Frames; lässt viel Rauschen in den Ableitungen.</translation>
    </message>
    <message>
        <source>Rauch–Tung–Striebel</source>
        <translation>Rauch–Tung–Striebel</translation>
    </message>
    <message>
        <source>Kalman filter of position, velocity and acceleration, run forwards and backwards.</source>
        <translation>Kalman-Filter über Ort, Geschwindigkeit und Beschleunigung, vorwärts und rückwärts.</translation>
    </message>
    <message>
        <source>Local polynomial; keeps peaks, smooths little.</source>
        <translation>Örtliches Polynom; behält Spitzen, glättet wenig.</translation>
    </message>
    <message>
        <source>Whittaker–Henderson</source>
        <translation>Whittaker–Henderson</translation>
    </message>
    <message>
        <source>Penalises the third difference; one likeliest weight for each coordinate.</source>
        <translation>Bestraft die dritte Differenz; ein wahrscheinlichstes Gewicht für jede Koordinate.</translation>
    </message>
    <message>
        <source>Cross-validated spline</source>
        <translation>Kreuzvalidierter Spline</translation>
    </message>
    <message>
        <source>Smoothing spline that chooses its own weight for each coordinate and stretch.</source>
        <translation>Glättender Spline, der sein Gewicht für jede Koordinate und jeden Abschnitt selbst wählt.</translation>
    </message>
    <message>
        <source>Control points</source>
        <translation>Kontrollpunkte</translation>
    </message>
    <message>
        <source>Control points for the whole take; a stretch gets its share</source>
        <translation>Kontrollpunkte für die ganze Aufnahme; ein Abschnitt bekommt seinen Anteil</translation>
    </message>
    <message>
        <source>Degree</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>Degree of the pieces</source>
        <translation>Grad der Stücke</translation>
    </message>
    <message>
        <source>Cutoff</source>
        <translation>Grenzfrequenz</translation>
    </message>
    <message>
        <source>Half power after both passes</source>
        <translation>Halbe Leistung nach beiden Durchgängen</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Ordnung</translation>
    </message>
    <message>
        <source>Order of one pass; two are made</source>
        <translation>Ordnung eines Durchgangs; zwei werden gemacht</translation>
    </message>
    <message>
        <source>Measurement error</source>
        <translation>Messfehler</translation>
    </message>
    <message>
        <source>E_mea; the larger, the smoother and later</source>
        <translation>E_mea; je größer, desto glatter und später</translation>
    </message>
    <message>
        <source>Process</source>
        <translation>Prozess</translation>
    </message>
    <message>
        <source>Share of each change added to the error</source>
        <translation>Anteil jeder Änderung, der zum Fehler kommt</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Symmetric</source>
        <translation>Symmetrisch</translation>
    </message>
    <message>
        <source>As much future as past (odd lengths); else the past, which lags</source>
        <translation>Zukunft so viel wie Vergangenheit (ungerade Längen); sonst nur Vergangenheit, die nachhinkt</translation>
    </message>
    <message>
        <source>Of a sample; 0 to estimate it</source>
        <translation>Eines Werts; 0, um es zu schätzen</translation>
    </message>
    <message>
        <source>Jerk</source>
        <translation>Ruck</translation>
    </message>
    <message>
        <source>Root of the white jerk&apos;s spectral density; 0 to estimate it</source>
        <translation>Wurzel der Spektraldichte des weißen Rucks; 0, um sie zu schätzen</translation>
    </message>
    <message>
        <source>Order of the penalised difference</source>
        <translation>Ordnung der bestraften Differenz</translation>
    </message>
    <message>
        <source>Frequency that is halved; 0 for the likeliest of each coordinate</source>
        <translation>Frequenz, die halbiert wird; 0 für die wahrscheinlichste jeder Koordinate</translation>
    </message>
    <message>
        <source>Penalty</source>
        <translation>Strafe</translation>
    </message>
    <message>
        <source>Weight in frames³; 0 for cross-validation</source>
        <translation>Gewicht in Frames³; 0 für Kreuzvalidierung</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>X coordinate</source>
        <translation>X-Koordinate</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y</translation>
    </message>
    <message>
        <source>Y coordinate</source>
        <translation>Y-Koordinate</translation>
    </message>
    <message>
        <source>Z</source>
        <translation>Z</translation>
    </message>
    <message>
        <source>Z coordinate</source>
        <translation>Z-Koordinate</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Accel.</source>
        <translation>Beschl.</translation>
    </message>
    <message>
        <source>Acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Distance to another marker</source>
        <translation>Abstand zu einem anderen Marker</translation>
    </message>
    <message>
        <source>Off body</source>
        <translation>Vom Körper</translation>
    </message>
    <message>
        <source>Distance to the body&apos;s prediction</source>
        <translation>Abstand zur Vorhersage des Körpers</translation>
    </message>
    <message>
        <source>Moved</source>
        <translation>Bewegt</translation>
    </message>
    <message>
        <source>Difference to the samples before repair</source>
        <translation>Unterschied zu den Werten vor der Reparatur</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>Residual in the file</source>
        <translation>Residuum in der Datei</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>Number of cameras in the file</source>
        <translation>Zahl der Kameras in der Datei</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
    <message>
        <source>accepted</source>
        <translation>angenommen</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>abgelehnt</translation>
    </message>
    <message>
        <source>repaired</source>
        <translation>repariert</translation>
    </message>
    <message>
        <source>Only what is nearly certain</source>
        <translation>Nur fast Sicheres</translation>
    </message>
    <message>
        <source>Balanced</source>
        <translation>Ausgewogen</translation>
    </message>
    <message>
        <source>All that looks odd</source>
        <translation>Alles Auffällige</translation>
    </message>
    <message>
        <source>Find gaps, peaks, noise and steps</source>
        <translation>Lücken, Spitzen, Rauschen und Sprünge gesucht</translation>
    </message>
    <message>
        <source>Find artifacts of all classes</source>
        <translation>Artefakte aller Klassen gesucht</translation>
    </message>
    <message>
        <source>{0}</source>
        <translation>{0}</translation>
    </message>
    <message>
        <source>Reading frames</source>
        <translation>Frames werden gelesen</translation>
    </message>
    <message>
        <source>Reading poses</source>
        <translation>Posen werden gelesen</translation>
    </message>
    <message>
        <source>Reading rows</source>
        <translation>Zeilen werden gelesen</translation>
    </message>
    <message>
        <source>Writing frames</source>
        <translation>Frames werden geschrieben</translation>
    </message>
    <message>
        <source>Writing poses</source>
        <translation>Posen werden geschrieben</translation>
    </message>
    <message>
        <source>Writing rows</source>
        <translation>Zeilen werden geschrieben</translation>
    </message>
    <message>
        <source>Comparing bytes</source>
        <translation>Bytes werden verglichen</translation>
    </message>
    <message>
        <source>Opening the review</source>
        <translation>Durchsicht wird geöffnet</translation>
    </message>
    <message>
        <source>Proposing repairs</source>
        <translation>Reparaturen werden vorgeschlagen</translation>
    </message>
    <message>
        <source>Predicting {0}</source>
        <translation>{0} wird vorhergesagt</translation>
    </message>
    <message>
        <source>gaps</source>
        <translation>Lücken</translation>
    </message>
    <message>
        <source>jumps, peaks and heavy noise</source>
        <translation>Sprünge, Spitzen und starkes Rauschen</translation>
    </message>
    <message>
        <source>what is wrong, and how sure that is</source>
        <translation>was falsch ist, und wie sicher</translation>
    </message>
    <message>
        <source>slow changes</source>
        <translation>langsame Veränderungen</translation>
    </message>
    <message>
        <source>slow changes of {0}</source>
        <translation>langsame Veränderungen an {0}</translation>
    </message>
    <message>
        <source>slow changes, filled</source>
        <translation>langsame Veränderungen, aufgefüllt</translation>
    </message>
    <message>
        <source>the body&apos;s structure</source>
        <translation>der Aufbau des Körpers</translation>
    </message>
    <message>
        <source>body mesh</source>
        <translation>Aufbau des Körpers</translation>
    </message>
    <message>
        <source>body mesh of {0}</source>
        <translation>Aufbau von {0}</translation>
    </message>
    <message>
        <source>residuals</source>
        <translation>Abstände</translation>
    </message>
    <message>
        <source>residual of {0}</source>
        <translation>Abstand von {0}</translation>
    </message>
    <message>
        <source>Looking for noise</source>
        <translation>Rauschen wird gesucht</translation>
    </message>
    <message>
        <source>Smoothing</source>
        <translation>Glätten</translation>
    </message>
    <message>
        <source>Smoothing again</source>
        <translation>Glätten, noch einmal</translation>
    </message>
    <message>
        <source>Filling</source>
        <translation>Auffüllen</translation>
    </message>
    <message>
        <source>Filling again</source>
        <translation>Auffüllen, noch einmal</translation>
    </message>
    <message>
        <source>Keeping bones</source>
        <translation>Knochen behalten ihre Länge</translation>
    </message>
    <message>
        <source>joint centres</source>
        <translation>Gelenkzentren</translation>
    </message>
    <message>
        <source>Compiling the network</source>
        <translation>Das Netz wird übersetzt</translation>
    </message>
    <message>
        <source>Learning how the body moves, round {0} of {1}</source>
        <translation>Lernt, wie der Körper sich bewegt, Runde {0} von {1}</translation>
    </message>
    <message>
        <source>No joint centre can be told from this take; that needs two neighbouring rigid groups of {0} markers or more that turn against each other. {1}: {2}.</source>
        <translation>Aus dieser Aufnahme lässt sich kein Gelenkzentrum bestimmen; dazu braucht es zwei benachbarte starre Gruppen von mindestens {0} Markern, die sich gegeneinander drehen. {1}: {2}.</translation>
    </message>
    <message>
        <source>No joint centre can be told from this take; that needs two neighbouring rigid groups of {0} markers or more that turn against each other.</source>
        <translation>Aus dieser Aufnahme lässt sich kein Gelenkzentrum bestimmen; dazu braucht es zwei benachbarte starre Gruppen von mindestens {0} Markern, die sich gegeneinander drehen.</translation>
    </message>
    <message>
        <source>{0} has fewer than {1} markers</source>
        <translation>{0} hat weniger als {1} Marker</translation>
    </message>
    <message>
        <source>the markers of {0} are hardly ever seen together</source>
        <translation>die Marker von {0} sind kaum je zusammen zu sehen</translation>
    </message>
    <message>
        <source>the markers of {0} lie along one line</source>
        <translation>die Marker von {0} liegen auf einer Linie</translation>
    </message>
    <message>
        <source>its groups are hardly ever seen together</source>
        <translation>seine Gruppen sind kaum je zusammen zu sehen</translation>
    </message>
    <message>
        <source>its groups turn against each other about some axis by {0}° only</source>
        <translation>seine Gruppen drehen sich um eine Achse nur um {0}° gegeneinander</translation>
    </message>
    <message>
        <source>its groups turn against each other about a second axis by {0}° only</source>
        <translation>seine Gruppen drehen sich um eine zweite Achse nur um {0}° gegeneinander</translation>
    </message>
    <message>
        <source>it turns least about the limb&apos;s own length, where no joint beside it tells of it</source>
        <translation>es dreht sich am wenigsten um die Längsachse des Glieds, wo kein Gelenk daneben etwas verrät</translation>
    </message>
    <message>
        <source>it could lie {0} mm off: {1}° is too little turning for an error of {2} mm</source>
        <translation>es könnte {0} mm daneben liegen: {1}° Drehung sind zu wenig bei einem Fehler von {2} mm</translation>
    </message>
    <message>
        <source>This is a skeleton recording: its joints are in it already.</source>
        <translation>Das ist eine Skelettaufnahme: Ihre Gelenke sind schon darin.</translation>
    </message>
    <message>
        <source>movement</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>the joints beside it</source>
        <translation>die Gelenke daneben</translation>
    </message>
    <message>
        <source>the markers&apos; middle</source>
        <translation>die Mitte der Marker</translation>
    </message>
    <message>
        <source>{0} samples have the residual word 65535, which is -1 without its sign; they were read as missing.</source>
        <translation>{0} Werte haben das Residuenwort 65535, also -1 ohne Vorzeichen; sie wurden als fehlend gelesen.</translation>
    </message>
    <message>
        <source>{0} samples at exactly (0, 0, 0) with a valid residual were read as missing.</source>
        <translation>{0} Werte bei genau (0, 0, 0) mit gültigem Residuum wurden als fehlend gelesen.</translation>
    </message>
    <message>
        <source>{0} samples at exactly (0, 0, 0) were read as missing.</source>
        <translation>{0} Werte bei genau (0, 0, 0) wurden als fehlend gelesen.</translation>
    </message>
    <message>
        <source>{0} samples whose coordinates are no numbers, or farther out than any room, were read as missing.</source>
        <translation>{0} Werte, deren Koordinaten keine Zahlen sind oder weiter draußen liegen als jeder Raum, wurden als fehlend gelesen.</translation>
    </message>
    <message>
        <source>{0} cells that are no numbers were read as missing.</source>
        <translation>{0} Zellen, die keine Zahlen sind, wurden als fehlend gelesen.</translation>
    </message>
    <message>
        <source>Labels that occur more than once were numbered: {0}.</source>
        <translation>Mehrfach vorkommende Namen wurden nummeriert: {0}.</translation>
    </message>
    <message>
        <source>Of columns that stand more than once the first was read: {0}.</source>
        <translation>Von Spalten, die mehrmals vorkommen, wurde die erste gelesen: {0}.</translation>
    </message>
    <message>
        <source>The file marks every sample as invalid, yet has coordinates; they were read as valid.</source>
        <translation>Die Datei nennt jeden Wert ungültig, hat aber Koordinaten; sie wurden als gültig gelesen.</translation>
    </message>
    <message>
        <source>{0} is gone or holds no prior, so that Markermend&apos;s own is used.</source>
        <translation>{0} fehlt oder lehrt keine Bewegung; es gilt, was Markermend kennt.</translation>
    </message>
    <message>
        <source>The file tells no unit of length; by the size of things metres were assumed.</source>
        <translation>Die Datei nennt keine Längeneinheit; der Größe nach wurden Meter angenommen.</translation>
    </message>
    <message>
        <source>The file tells no unit of length; by the size of things millimetres were assumed.</source>
        <translation>Die Datei nennt keine Längeneinheit; der Größe nach wurden Millimeter angenommen.</translation>
    </message>
    <message>
        <source>The file tells no unit of length; by the size of things {0} were assumed.</source>
        <translation>Die Datei nennt keine Längeneinheit; der Größe nach wurden {0} angenommen.</translation>
    </message>
    <message>
        <source>The file tells no unit of length; millimetres were assumed.</source>
        <translation>Die Datei nennt keine Längeneinheit; Millimeter wurden angenommen.</translation>
    </message>
    <message>
        <source>The file tells no unit of length that is known; millimetres were assumed.</source>
        <translation>Die Datei nennt keine bekannte Längeneinheit; Millimeter wurden angenommen.</translation>
    </message>
    <message>
        <source>The columns tell no unit of length that is known; millimetres were assumed.</source>
        <translation>Die Spalten nennen keine bekannte Längeneinheit; Millimeter wurden angenommen.</translation>
    </message>
    <message>
        <source>No column tells how joints are turned, as qx, qy, qz and qw would.</source>
        <translation>Keine Spalte nennt, wie Gelenke gedreht sind, wie es qx, qy, qz und qw täten.</translation>
    </message>
    <message>
        <source>The file tells no unit; {0} were assumed.</source>
        <translation>Die Datei nennt keine Einheit; angenommen wurden {0}.</translation>
    </message>
    <message>
        <source>The table has no times; 100 Hz was assumed.</source>
        <translation>Die Tabelle hat keine Zeiten; 100 Hz wurden angenommen.</translation>
    </message>
    <message>
        <source>The file does not tell its frame rate; its times were used.</source>
        <translation>Die Datei nennt ihre Bildrate nicht; ihre Zeiten wurden verwendet.</translation>
    </message>
    <message>
        <source>The file does not tell its frame rate; 100 Hz was assumed.</source>
        <translation>Die Datei nennt ihre Bildrate nicht; 100 Hz wurden angenommen.</translation>
    </message>
    <message>
        <source>The file tells no rate; 120 Hz was assumed.</source>
        <translation>Die Datei nennt keine Rate; 120 Hz wurden angenommen.</translation>
    </message>
    <message>
        <source>The file is cut short: it says that it has {0} frames, {1} are present.</source>
        <translation>Die Datei ist abgeschnitten: sie soll {0} Frames haben, {1} sind vorhanden.</translation>
    </message>
    <message>
        <source>The file is cut short; the poses before its end were read.</source>
        <translation>Die Datei ist abgeschnitten; die Posen vor ihrem Ende wurden gelesen.</translation>
    </message>
    <message>
        <source>The file is cut short; its last pose was left out.</source>
        <translation>Die Datei ist abgeschnitten; ihre letzte Pose wurde weggelassen.</translation>
    </message>
    <message>
        <source>The file is cut short; what its last pose lacks was read as missing.</source>
        <translation>Die Datei ist abgeschnitten; was ihrer letzten Pose fehlt, wurde als nicht gesehen gelesen.</translation>
    </message>
    <message>
        <source>The file is cut short; its last row was left out.</source>
        <translation>Die Datei ist abgeschnitten; ihre letzte Zeile wurde ausgelassen.</translation>
    </message>
    <message>
        <source>{0} rows stand twice, line {1} for one; they were read once.</source>
        <translation>{0} Zeilen stehen doppelt da, etwa Zeile {1}; sie wurden einmal gelesen.</translation>
    </message>
    <message>
        <source>The times in the file grow too fast for seconds; milliseconds were assumed.</source>
        <translation>Die Zeiten in der Datei wachsen zu schnell für Sekunden; Millisekunden wurden angenommen.</translation>
    </message>
    <message>
        <source>The times in the file grow too fast for seconds; microseconds were assumed.</source>
        <translation>Die Zeiten in der Datei wachsen zu schnell für Sekunden; Mikrosekunden wurden angenommen.</translation>
    </message>
    <message>
        <source>The times in the file grow too fast for seconds; nanoseconds were assumed.</source>
        <translation>Die Zeiten in der Datei wachsen zu schnell für Sekunden; Nanosekunden wurden angenommen.</translation>
    </message>
    <message>
        <source>Times in the file jump or stand still (after frame {0}, for one); the rate is that between most poses.</source>
        <translation>Zeiten in der Datei springen oder stehen still (etwa nach Frame {0}); als Rate gilt die zwischen den meisten Posen.</translation>
    </message>
    <message>
        <source>Frame numbers go from {0} to {1} in line {2}; poses were read one after the other.</source>
        <translation>Die Nummern der Frames springen in Zeile {2} von {0} auf {1}; die Posen wurden nacheinander gelesen.</translation>
    </message>
    <message>
        <source>Frame numbers leave out {0} poses, from {1} to {2} in line {3} for one; they were read as gaps.</source>
        <translation>Die Nummern der Frames lassen {0} Posen aus, etwa in Zeile {3} von {1} auf {2}; sie wurden als Lücken gelesen.</translation>
    </message>
    <message>
        <source>Times tell of {0} poses that are missing, after frame {1} for one; they were read as gaps, and frames after them are numbered anew.</source>
        <translation>Nach den Zeiten fehlen {0} Posen, etwa nach Frame {1}; sie wurden als Lücken gelesen, und Frames danach sind neu nummeriert.</translation>
    </message>
    <message>
        <source>Times in the file run backwards and tell no rate; {0} Hz was assumed.</source>
        <translation>Die Zeiten in der Datei laufen rückwärts und sagen keine Rate; {0} Hz wurden angenommen.</translation>
    </message>
    <message>
        <source>Times in the file stand still and tell no rate; {0} Hz was assumed.</source>
        <translation>Die Zeiten in der Datei stehen still und sagen keine Rate; {0} Hz wurden angenommen.</translation>
    </message>
    <message>
        <source>Frames are numbered {0}, {1} and so on; they were read as following one another.</source>
        <translation>Die Frames sind mit {0}, {1} und so weiter nummeriert; sie wurden als aufeinanderfolgend gelesen.</translation>
    </message>
    <message>
        <source>No number stands before {0} poses, in line {1} for one; they were read all the same.</source>
        <translation>Vor {0} Posen steht keine Nummer, etwa in Zeile {1}; sie wurden trotzdem gelesen.</translation>
    </message>
    <message>
        <source>The header counts {0} frames; {1} were read.</source>
        <translation>Der Dateikopf zählt {0} Frames; {1} wurden gelesen.</translation>
    </message>
    <message>
        <source>Its skeleton is taken to be {0}, the only one here.</source>
        <translation>Als Skelett wurde {0} genommen, das einzige hier.</translation>
    </message>
    <message>
        <source>Segments the skeleton does not have were left out: {0}.</source>
        <translation>Segmente, die das Skelett nicht hat, wurden ausgelassen: {0}.</translation>
    </message>
    <message>
        <source>Segments without movement, left as at rest: {0}.</source>
        <translation>Segmente ohne Bewegung, in Ruhelage belassen: {0}.</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>text</source>
        <translation>Text</translation>
    </message>
    <message>
        <source>16-bit integers</source>
        <translation>16-Bit-Ganzzahlen</translation>
    </message>
    <message>
        <source>32-bit floats</source>
        <translation>32-Bit-Gleitkommazahlen</translation>
    </message>
    <message>
        <source>far-off coordinates or (0, 0, 0)</source>
        <translation>weit entfernte Koordinaten oder (0, 0, 0)</translation>
    </message>
    <message>
        <source>residuals mean nothing</source>
        <translation>Residuen ohne Bedeutung</translation>
    </message>
    <message>
        <source>negative residual ({0} samples)</source>
        <translation>negatives Residuum ({0} Werte)</translation>
    </message>
    <message>
        <source>residual word 65535, read as -1 ({0} samples)</source>
        <translation>Residuenwort 65535, als -1 gelesen ({0} Werte)</translation>
    </message>
    <message>
        <source>(0, 0, 0) with a valid residual ({0} samples)</source>
        <translation>(0, 0, 0) mit gültigem Residuum ({0} Werte)</translation>
    </message>
    <message>
        <source>no place in a room ({0} samples)</source>
        <translation>kein Ort in einem Raum ({0} Werte)</translation>
    </message>
    <message>
        <source>metres</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>centimetres</source>
        <translation>Zentimeter</translation>
    </message>
    <message>
        <source>millimetres</source>
        <translation>Millimeter</translation>
    </message>
    <message>
        <source>inches</source>
        <translation>Zoll</translation>
    </message>
    <message>
        <source>1/0.45 inches (as in files of the CMU database)</source>
        <translation>1/0,45 Zoll (wie in Dateien der CMU-Datenbank)</translation>
    </message>
    <message>
        <source>{0} is empty; look for another copy of it.</source>
        <translation>{0} ist leer; suchen Sie eine andere Kopie.</translation>
    </message>
    <message>
        <source>{0} is text in UTF-16, as PowerShell and Excel write it; save it as UTF-8.</source>
        <translation>{0} ist Text in UTF-16, wie PowerShell und Excel ihn schreiben; speichern Sie ihn als UTF-8.</translation>
    </message>
    <message>
        <source>{0} is not a C3D file; its first bytes are not a C3D header.</source>
        <translation>{0} ist keine C3D-Datei; die ersten Bytes sind kein C3D-Kopf.</translation>
    </message>
    <message>
        <source>{0} is of an unknown kind; C3D, TRC, CSV, AMC, ASF and BVH can be read.</source>
        <translation>{0} ist von unbekannter Art; gelesen werden C3D, TRC, CSV, AMC, ASF und BVH.</translation>
    </message>
    <message>
        <source>{0} is damaged: its header puts the parameters at byte {1}, where there are none; look for another copy of it.</source>
        <translation>{0} ist beschädigt: Nach dem Dateikopf stehen die Parameter bei Byte {1}, wo keine sind; suchen Sie eine andere Kopie.</translation>
    </message>
    <message>
        <source>{0} is damaged: its frames would begin beyond its end, at byte {1} of {2}; look for another copy of it.</source>
        <translation>{0} ist beschädigt: Die Frames würden hinter dem Ende beginnen, bei Byte {1} von {2}; suchen Sie eine andere Kopie.</translation>
    </message>
    <message>
        <source>{0} holds no frame: by its header it ends before it begins.</source>
        <translation>{0} enthält keinen Frame: Nach dem Dateikopf endet die Aufnahme vor ihrem Anfang.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} opens a quote (&quot;) that it does not close.</source>
        <translation>{0} ist beschädigt: Zeile {1} öffnet ein Anführungszeichen (&quot;), das sie nicht schließt.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} says “{2}” where {3} should be a number.</source>
        <translation>{0} ist beschädigt: In Zeile {1} steht „{2}“, wo {3} eine Zahl sein sollte.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} has {2} cells, the header {3}.</source>
        <translation>{0} ist beschädigt: Zeile {1} hat {2} Zellen, der Kopf {3}.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} has {2} numbers for {3} channels.</source>
        <translation>{0} ist beschädigt: Zeile {1} hat {2} Zahlen für {3} Kanäle.</translation>
    </message>
    <message>
        <source>{0} is damaged: lines {1} and {2} both tell of “{3}” in one frame, and differ.</source>
        <translation>{0} ist beschädigt: Die Zeilen {1} und {2} nennen beide „{3}“ in einem Frame, aber verschieden.</translation>
    </message>
    <message>
        <source>{0} is damaged: “{1}” in line {2} is no frame number.</source>
        <translation>{0} ist beschädigt: „{1}“ in Zeile {2} ist keine Nummer eines Frames.</translation>
    </message>
    <message>
        <source>{0} would have {1} poses a second, which is no rate of a recording; {2} to {3} Hz can be read.</source>
        <translation>{0} hätte {1} Posen in der Sekunde, was keine Aufnahme hat; lesbar sind {2} bis {3} Hz.</translation>
    </message>
    <message>
        <source>There is no file “{0}”; check its name and folder.</source>
        <translation>Es gibt keine Datei „{0}“; prüfen Sie Namen und Ordner.</translation>
    </message>
    <message>
        <source>There is no take at “{0}”; check its name and folder.</source>
        <translation>Bei „{0}“ gibt es keine Aufnahme; prüfen Sie Namen und Ordner.</translation>
    </message>
    <message>
        <source>“{0}” is a folder; name a file in it.</source>
        <translation>„{0}“ ist ein Ordner; nennen Sie eine Datei darin.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} begins with “{2}”, which is the number of no pose.</source>
        <translation>{0} ist beschädigt: Zeile {1} beginnt mit „{2}“, was keine Nummer einer Pose ist.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} has only numbers; it should begin with the name of a segment, or be the number of a pose.</source>
        <translation>{0} ist beschädigt: Zeile {1} enthält nur Zahlen; sie sollte mit dem Namen eines Segments beginnen oder die Nummer einer Pose sein.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} should give {2} {3} numbers, but reads “{4}”.</source>
        <translation>{0} ist beschädigt: Zeile {1} sollte für {2} {3} Zahlen nennen, lautet aber „{4}“.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} tells of {2} a second time in one pose.</source>
        <translation>{0} ist beschädigt: Zeile {1} nennt {2} ein zweites Mal in einer Pose.</translation>
    </message>
    <message>
        <source>{0} holds no pose of this skeleton.</source>
        <translation>{0} enthält keine Pose dieses Skeletts.</translation>
    </message>
    <message>
        <source>{0} is cut short: no pose follows its header.</source>
        <translation>{0} ist abgeschnitten: Auf den Kopf folgt keine Pose.</translation>
    </message>
    <message>
        <source>{0} is cut short: its last bone has no end.</source>
        <translation>{0} ist abgeschnitten: Dem letzten Knochen fehlt das Ende.</translation>
    </message>
    <message>
        <source>{0} is no Acclaim skeleton: it has no :root or :bonedata.</source>
        <translation>{0} ist kein Acclaim-Skelett: :root oder :bonedata fehlt.</translation>
    </message>
    <message>
        <source>{0} is damaged: two bones have the same name.</source>
        <translation>{0} ist beschädigt: Zwei Knochen haben denselben Namen.</translation>
    </message>
    <message>
        <source>{0} is damaged: bone {1} has no length or direction.</source>
        <translation>{0} ist beschädigt: Der Knochen {1} hat keine Länge oder Richtung.</translation>
    </message>
    <message>
        <source>{0} is damaged: bone {1} does not hang on the root.</source>
        <translation>{0} ist beschädigt: Der Knochen {1} hängt nicht an der Wurzel.</translation>
    </message>
    <message>
        <source>{0} is damaged: its hierarchy names {1}, which is no bone.</source>
        <translation>{0} ist beschädigt: Die Hierarchie nennt {1}, was kein Knochen ist.</translation>
    </message>
    <message>
        <source>{0} is damaged: its unit of length, {1} in line {2}, makes no body.</source>
        <translation>{0} ist beschädigt: Die Längeneinheit, {1} in Zeile {2}, ergibt keinen Körper.</translation>
    </message>
    <message>
        <source>{0} is damaged: its unit of length is {1}.</source>
        <translation>{0} ist beschädigt: Die Längeneinheit ist {1}.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} should have a number of a body, but reads “{2}”.</source>
        <translation>{0} ist beschädigt: Zeile {1} sollte eine Zahl eines Körpers enthalten, lautet aber „{2}“.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} should have {2} numbers of a body, but reads “{3}”.</source>
        <translation>{0} ist beschädigt: Zeile {1} sollte {2} Zahlen eines Körpers enthalten, lautet aber „{3}“.</translation>
    </message>
    <message>
        <source>{0} is damaged: line {1} names no joint.</source>
        <translation>{0} ist beschädigt: Zeile {1} nennt kein Gelenk.</translation>
    </message>
    <message>
        <source>{0} is damaged: the parent “{1}” is no joint of it.</source>
        <translation>{0} ist beschädigt: „{1}“, woran etwas hängen soll, ist kein Gelenk der Datei.</translation>
    </message>
    <message>
        <source>{0} is damaged: its frames go from {1} to {2}, with {3} rows.</source>
        <translation>{0} ist beschädigt: Die Frames reichen von {1} bis {2}, bei {3} Zeilen.</translation>
    </message>
    <message>
        <source>{0} is no table of joints: it lacks the column “{1}”; it should have {2}.</source>
        <translation>{0} ist keine Tabelle von Gelenken: Die Spalte „{1}“ fehlt; vorhanden sein sollten {2}.</translation>
    </message>
    <message>
        <source>{0} does not say what “{1}” hangs on; add a column “parent”.</source>
        <translation>{0} gibt nicht an, woran „{1}“ hängt; ergänzen Sie eine Spalte „parent“.</translation>
    </message>
    <message>
        <source>{0} has two columns “{1}”, of which one may tell how joints are turned; call that q{1}.</source>
        <translation>{0} hat zwei Spalten „{1}“, von denen eine sagen kann, wie Gelenke gedreht sind; nennen Sie diese q{1}.</translation>
    </message>
    <message>
        <source>{0} tells of several bodies (column “{1}”); write one of them into a file.</source>
        <translation>{0} enthält mehrere Körper (Spalte „{1}“); schreiben Sie einen davon in eine eigene Datei.</translation>
    </message>
    <message>
        <source>{0} holds no whole row.</source>
        <translation>{0} enthält keine vollständige Zeile.</translation>
    </message>
    <message>
        <source>{0} is damaged: it is cut short.</source>
        <translation>{0} ist beschädigt: Die Datei ist abgeschnitten.</translation>
    </message>
    <message>
        <source>{0} is damaged: it does not begin with HIERARCHY.</source>
        <translation>{0} ist beschädigt: Die Datei beginnt nicht mit HIERARCHY.</translation>
    </message>
    <message>
        <source>{0} is damaged: it has two joints called “{1}”.</source>
        <translation>{0} ist beschädigt: Zwei Gelenke heißen „{1}“.</translation>
    </message>
    <message>
        <source>{0} is damaged: more poses follow than the {1} that it tells of.</source>
        <translation>{0} ist beschädigt: Es folgen mehr Posen als die {1} angegebenen.</translation>
    </message>
    <message>
        <source>{0} is damaged: “{1}” in line {2} is no finite number.</source>
        <translation>{0} ist beschädigt: „{1}“ in Zeile {2} ist keine endliche Zahl.</translation>
    </message>
    <message>
        <source>{0} is no skeleton recording; its name should end in {1}.</source>
        <translation>{0} ist keine Skelettaufnahme; der Name sollte auf {1} enden.</translation>
    </message>
    <message>
        <source>{0} should end in {1}, to tell what to write.</source>
        <translation>{0} sollte auf {1} enden, damit klar ist, was zu schreiben ist.</translation>
    </message>
    <message>
        <source>{0} needs a skeleton (ASF), and these joints have none: only those of an AMC have, as they were read; write a CSV.</source>
        <translation>{0} braucht ein Skelett (ASF), und diese Gelenke haben keines: Nur die einer AMC-Datei haben es, so wie sie gelesen wurden; schreiben Sie eine CSV-Datei.</translation>
    </message>
    <message>
        <source>There is no pose to write into a BVH.</source>
        <translation>Es gibt keine Pose, die in eine BVH-Datei zu schreiben wäre.</translation>
    </message>
    <message>
        <source>A BVH holds rotations, which this recording has none of; write a CSV.</source>
        <translation>Eine BVH-Datei enthält Drehungen, und diese Aufnahme hat keine; schreiben Sie eine CSV-Datei.</translation>
    </message>
    <message>
        <source>A BVH holds every joint of every pose, and {0} was never seen; write a CSV.</source>
        <translation>Eine BVH-Datei enthält jedes Gelenk jeder Pose, und nie zu sehen war: {0}; schreiben Sie eine CSV-Datei.</translation>
    </message>
    <message>
        <source>A BVH has one root; this recording has several.</source>
        <translation>Eine BVH-Datei hat eine Wurzel; diese Aufnahme hat mehrere.</translation>
    </message>
    <message>
        <source>An AMC cannot say that a segment is never seen, and would show {0} at rest. Write more frames, repair these gaps first, or write a CSV.</source>
        <translation>Eine AMC-Datei kann nicht angeben, dass ein Segment nie zu sehen ist, und würde {0} in Ruhelage zeigen. Schreiben Sie mehr Frames, reparieren Sie zuerst diese Lücken, oder schreiben Sie eine CSV-Datei.</translation>
    </message>
    <message>
        <source>A BVH of these joints could not be read again: {0}; rename joints, or write a CSV.</source>
        <translation>Eine BVH-Datei dieser Gelenke ließe sich nicht wieder lesen: {0}; benennen Sie Gelenke um, oder schreiben Sie eine CSV-Datei.</translation>
    </message>
    <message>
        <source>“{0}” may not be read; check its permissions.</source>
        <translation>„{0}“ darf nicht gelesen werden; prüfen Sie die Zugriffsrechte.</translation>
    </message>
    <message>
        <source>“{0}” cannot be opened: {1}.</source>
        <translation>„{0}“ lässt sich nicht öffnen: {1}.</translation>
    </message>
    <message>
        <source>{0} could not be written: {1}; nothing was changed, choose another place or free some space.</source>
        <translation>{0} konnte nicht geschrieben werden: {1}; nichts wurde geändert. Wählen Sie einen anderen Ort oder schaffen Sie Platz.</translation>
    </message>
    <message>
        <source>The review made of this take at “{0}” goes on here.</source>
        <translation>Die Durchsicht dieser Aufnahme von „{0}“ geht hier weiter.</translation>
    </message>
    <message>
        <source>The take was exported over its original. What was not repaired of its review goes on here; the review so far stays in “{0}”.</source>
        <translation>Die Aufnahme wurde über ihr Original exportiert. Was von der Durchsicht nicht repariert ist, geht hier weiter; die bisherige Durchsicht bleibt in „{0}“.</translation>
    </message>
    <message>
        <source>The take has changed since it was reviewed: what was decided on the {0} markers that are the same was kept, on {1} it was not; the old review stays in “{2}”.</source>
        <translation>Die Aufnahme hat sich seit der Durchsicht geändert: Was an den {0} gleichen Markern entschieden wurde, bleibt, an {1} nicht; die alte Durchsicht steht weiter in „{2}“.</translation>
    </message>
    <message>
        <source>The take has changed since it was reviewed: what was decided on the {0} joints that are the same was kept, on {1} it was not; the old review stays in “{2}”.</source>
        <translation>Die Aufnahme hat sich seit der Durchsicht geändert: Was an den {0} gleichen Gelenken entschieden wurde, bleibt, an {1} nicht; die alte Durchsicht steht weiter in „{2}“.</translation>
    </message>
    <message>
        <source>{0} is not used: {1}</source>
        <translation>{0} wird nicht verwendet: {1}</translation>
    </message>
    <message>
        <source>{0} may be about {1} mm off.</source>
        <translation>{0} kann etwa {1} mm daneben liegen.</translation>
    </message>
    <message>
        <source>Accept {0}</source>
        <translation>Angenommen: {0}</translation>
    </message>
    <message>
        <source>Reject {0}</source>
        <translation>Abgelehnt: {0}</translation>
    </message>
    <message>
        <source>Reopen {0}</source>
        <translation>Wieder geöffnet: {0}</translation>
    </message>
    <message>
        <source>Mark {0}</source>
        <translation>Markiert: {0}</translation>
    </message>
    <message>
        <source>Remove {0}</source>
        <translation>Entfernt: {0}</translation>
    </message>
    <message>
        <source>Adjust {0}</source>
        <translation>Angepasst: {0}</translation>
    </message>
    <message>
        <source>Nudge the beginning of {0}</source>
        <translation>Anfang verschoben: {0}</translation>
    </message>
    <message>
        <source>Nudge the end of {0}</source>
        <translation>Ende verschoben: {0}</translation>
    </message>
    <message>
        <source>Split {0}</source>
        <translation>Geteilt: {0}</translation>
    </message>
    <message>
        <source>Note on {0}</source>
        <translation>Notiz: {0}</translation>
    </message>
    <message>
        <source>Repair {0} artifacts alike ({1})</source>
        <translation>{0} gleichartige Artefakte repariert ({1})</translation>
    </message>
    <message>
        <source>Repair {0} by hand</source>
        <translation>Von Hand repariert: {0}</translation>
    </message>
    <message>
        <source>Repair {0}</source>
        <translation>Repariert: {0}</translation>
    </message>
    <message>
        <source>Swap {0} and {1} by hand</source>
        <translation>{0} und {1} von Hand getauscht</translation>
    </message>
    <message>
        <source>Call {0} on {1} {2}</source>
        <translation>{0} an {1} umbenannt in {2}</translation>
    </message>
    <message>
        <source>Cut {0} in {1}</source>
        <translation>{0} ausgeschnitten, {1}</translation>
    </message>
    <message>
        <source>Move {0} to {1} in {2}</source>
        <translation>{0} zu {1} verschoben, {2}</translation>
    </message>
    <message>
        <source>Merge {0} into {1}</source>
        <translation>{0} mit {1} vereint</translation>
    </message>
    <message>
        <source>Smooth {0} in {1}</source>
        <translation>{0} geglättet, {1}</translation>
    </message>
    <message>
        <source>Rename {0} to {1}</source>
        <translation>{0} umbenannt in {1}</translation>
    </message>
    <message>
        <source>Join {0} on {1}</source>
        <translation>{0} an {1} verbunden</translation>
    </message>
    <message>
        <source>Lower {0} ({1} on {2})</source>
        <translation>{0} herabgestuft ({1} an {2})</translation>
    </message>
    <message>
        <source>Leave {0} ({1} on {2})</source>
        <translation>{0} belassen ({1} an {2})</translation>
    </message>
    <message>
        <source>Detect ({0})</source>
        <translation>Gesucht ({0})</translation>
    </message>
    <message>
        <source>Review frames {0}–{1} only</source>
        <translation>Nur Frames {0}–{1} durchsehen</translation>
    </message>
    <message>
        <source>{0} artifacts</source>
        <translation>{0} Artefakte</translation>
    </message>
    <message>
        <source>{0} artifact</source>
        <translation>{0} Artefakt</translation>
    </message>
    <message>
        <source>{0} markers</source>
        <translation>{0} Marker</translation>
    </message>
    <message>
        <source>{0} joints</source>
        <translation>{0} Gelenke</translation>
    </message>
    <message>
        <source>frames {0}–{1}</source>
        <translation>Frames {0}–{1}</translation>
    </message>
    <message>
        <source>all frames</source>
        <translation>alle Frames</translation>
    </message>
    <message>
        <source>marked by hand</source>
        <translation>von Hand markiert</translation>
    </message>
    <message>
        <source>called {0} by hand</source>
        <translation>von Hand {0} genannt</translation>
    </message>
    <message>
        <source>its frames were set by hand</source>
        <translation>die Frames wurden von Hand gesetzt</translation>
    </message>
    <message>
        <source>was taken for a mix-up with {0}, which was repaired by itself</source>
        <translation>galt als Vertauschung mit {0}, das für sich repariert wurde</translation>
    </message>
    <message>
        <source>{0}; {1} times its usual scatter</source>
        <translation>{0}; {1}-mal seine übliche Streuung</translation>
    </message>
    <message>
        <source>{0}; {1} cameras see it instead of {2}</source>
        <translation>{0}; {1} Kameras sehen ihn statt {2}</translation>
    </message>
    <message>
        <source>not seen for 1 frame, since samples were cut or moved by hand</source>
        <translation>1 Frame lang nicht gesehen, da von Hand ausgeschnitten oder verschoben wurde</translation>
    </message>
    <message>
        <source>not seen for {0} frames, since samples were cut or moved by hand</source>
        <translation>{0} Frames lang nicht gesehen, da von Hand ausgeschnitten oder verschoben wurde</translation>
    </message>
    <message>
        <source>not seen for {0} of the {1} frames that were chosen by hand</source>
        <translation>{0} der {1} von Hand gewählten Frames lang nicht gesehen</translation>
    </message>
    <message>
        <source>not seen for {0}</source>
        <translation>nicht gesehen, {0} lang</translation>
    </message>
    <message>
        <source>sticks out by {0} for {1}, its neighbours do not</source>
        <translation>ragt um {0} heraus, {1} lang, seine Nachbarn nicht</translation>
    </message>
    <message>
        <source>sticks out by {0} for {1}, its neighbours by {2}</source>
        <translation>ragt um {0} heraus, {1} lang, seine Nachbarn um {2}</translation>
    </message>
    <message>
        <source>jitters by about {0} for {1}, {2} times its usual; its neighbours are calm</source>
        <translation>zittert um etwa {0}, {1} lang, {2}-mal so stark wie sonst; seine Nachbarn sind ruhig</translation>
    </message>
    <message>
        <source>jitters by about {0} for {1}, {2} times its usual</source>
        <translation>zittert um etwa {0}, {1} lang, {2}-mal so stark wie sonst</translation>
    </message>
    <message>
        <source>jumps {0} in one frame and slides back within {1}</source>
        <translation>springt {0} in einem Frame und gleitet in {1} zurück</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours do not, and comes back {1} later</source>
        <translation>springt {0} in einem Frame, seine Nachbarn nicht, und kommt {1} später zurück</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours by {1}, and comes back {2} later</source>
        <translation>springt {0} in einem Frame, seine Nachbarn {1}, und kommt {2} später zurück</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours do not, and slides back within {1}</source>
        <translation>springt {0} in einem Frame, seine Nachbarn nicht, und gleitet in {1} zurück</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours by {1}, and slides back within {2}</source>
        <translation>springt {0} in einem Frame, seine Nachbarn {1}, und gleitet in {2} zurück</translation>
    </message>
    <message>
        <source>slides {0} off within {1} and jumps back, its neighbours do not</source>
        <translation>gleitet {0} weg in {1} und springt zurück, seine Nachbarn nicht</translation>
    </message>
    <message>
        <source>slides {0} off within {1} and jumps back, its neighbours by {2}</source>
        <translation>gleitet {0} weg in {1} und springt zurück, seine Nachbarn um {2}</translation>
    </message>
    <message>
        <source>slides {0} off within {1} and jumps back</source>
        <translation>gleitet {0} weg in {1} und springt zurück</translation>
    </message>
    <message>
        <source>slides {0} off, jumps past its course and slides back, {1} in all</source>
        <translation>gleitet {0} weg, springt über seine Bahn hinaus und gleitet zurück, {1} in allem</translation>
    </message>
    <message>
        <source>lies {0} off for {1} beside a gap or an end, one jump away</source>
        <translation>liegt {0} daneben, {1} lang, an einer Lücke oder einem Ende, einen Sprung entfernt</translation>
    </message>
    <message>
        <source>drifts {0} off the place its neighbours give it and returns, within {1}</source>
        <translation>driftet {0} von dem Ort weg, den seine Nachbarn angeben, und kehrt zurück, in {1}</translation>
    </message>
    <message>
        <source>changes places with {0} for {1}: once exchanged, {2} of the {3} jump are left</source>
        <translation>tauscht den Platz mit {0}, {1} lang: zurückgetauscht bleiben {2} des Sprungs von {3}</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours do not, and stays off for {1}, up to an end of the take, at another distance from them: it moved on the body or fell off</source>
        <translation>springt {0} in einem Frame, seine Nachbarn nicht, und bleibt {1} lang bis zu einem Ende der Aufnahme daneben, in anderem Abstand zu ihnen: er ist verrutscht oder abgefallen</translation>
    </message>
    <message>
        <source>jumps {0} in one frame, its neighbours by {1}, and stays off for {2}, up to an end of the take, at another distance from them: it moved on the body or fell off</source>
        <translation>springt {0} in einem Frame, seine Nachbarn {1}, und bleibt {2} lang bis zu einem Ende der Aufnahme daneben, in anderem Abstand zu ihnen: er ist verrutscht oder abgefallen</translation>
    </message>
    <message>
        <source>seen for {0} inside a gap, {1} from where its neighbours put it; around the gap that is {2}</source>
        <translation>in einer Lücke gesehen, {0} lang, {1} von dem Ort, den seine Nachbarn angeben; um die Lücke sind es {2}</translation>
    </message>
    <message>
        <source>strays {0} from where its neighbours put it in the {1} before it is lost</source>
        <translation>gerät in den {1}, bevor er verloren geht, {0} neben die Stelle, an die seine Nachbarn ihn setzen</translation>
    </message>
    <message>
        <source>strays {0} from where its neighbours put it in the {1} after it is found again</source>
        <translation>liegt in den {1}, nachdem er wiedergefunden ist, {0} neben der Stelle, an die seine Nachbarn ihn setzen</translation>
    </message>
    <message>
        <source>repeats one position for {0} while its neighbours move {1}; in the end it is {2} off</source>
        <translation>wiederholt {0} lang einen Ort, während seine Nachbarn sich {1} bewegen; am Ende liegt er {2} daneben</translation>
    </message>
    <message>
        <source>repeats one position for {0}, as every marker does: the recording stands still</source>
        <translation>wiederholt {0} lang einen Ort, wie alle Marker: die Aufnahme steht still</translation>
    </message>
    <message>
        <source>sticks out by {0} for {1}</source>
        <translation>ragt um {0} heraus, {1} lang</translation>
    </message>
    <message>
        <source>jitters by up to {0} for {1}</source>
        <translation>zittert um bis zu {0}, {1} lang</translation>
    </message>
    <message>
        <source>jumps {0} in one frame and comes back {1} later</source>
        <translation>springt {0} in einem Frame und kommt {1} später zurück</translation>
    </message>
    <message>
        <source>deviates up to {0} from where its body says it should be, for {1}</source>
        <translation>weicht bis zu {0} von dem Ort ab, den sein Körper angibt, {1} lang</translation>
    </message>
    <message>
        <source>stands on the other side, and {0} here, for {1}</source>
        <translation>steht auf der anderen Seite und {0} hier, {1} lang</translation>
    </message>
    <message>
        <source>stands still while the body moves, for {0}</source>
        <translation>steht still, während der Körper sich bewegt, {0} lang</translation>
    </message>
    <message>
        <source>was guessed by the sensor, up to {0} from where the body has it, for {1}</source>
        <translation>wurde vom Sensor geraten, bis zu {0} von dort, wo der Körper es hat, {1} lang</translation>
    </message>
    <message>
        <source>stands still with the whole body, though that was moving, for {0}</source>
        <translation>steht mit dem ganzen Körper still, obwohl dieser sich bewegte, {0} lang</translation>
    </message>
    <message>
        <source>is said to stand at 0, 0, 0 for {0}</source>
        <translation>steht angeblich bei 0, 0, 0, {0} lang</translation>
    </message>
    <message>
        <source>is thrown off by a wrong angle, by up to {0}, for {1}</source>
        <translation>ist durch einen falschen Winkel um bis zu {0} versetzt, {1} lang</translation>
    </message>
    <message>
        <source>With only {0} to follow: {1}</source>
        <translation>Nur nach {0}: {1}</translation>
    </message>
    <message>
        <source>No other marker of the body is seen all through the interval of {0}; three are needed.</source>
        <translation>Kein anderer Marker des Körpers ist während des ganzen Intervalls von {0} zu sehen; drei sind nötig.</translation>
    </message>
    <message>
        <source>Only one other marker of the body is seen all through the interval of {0}; three are needed.</source>
        <translation>Nur ein anderer Marker des Körpers ist während des ganzen Intervalls von {0} zu sehen; drei sind nötig.</translation>
    </message>
    <message>
        <source>Only two others of the body are seen all through the interval of {0}; three are needed.</source>
        <translation>Nur zwei andere Marker des Körpers sind während des ganzen Intervalls von {0} zu sehen; drei sind nötig.</translation>
    </message>
    <message>
        <source>{0} is seen together with its references in only {1} frames; {2} are needed.</source>
        <translation>{0} ist nur in {1} Frames zusammen mit seinen Bezugsmarkern zu sehen; {2} sind nötig.</translation>
    </message>
    <message>
        <source>{0} has no trusted samples near the interval&apos;s beginning; needed: {1}.</source>
        <translation>{0} hat nahe am Anfang des Intervalls keine verlässlichen Messwerte; nötig: {1}.</translation>
    </message>
    <message>
        <source>{0} has no trusted samples near the interval&apos;s end; needed: {1}.</source>
        <translation>{0} hat nahe am Ende des Intervalls keine verlässlichen Messwerte; nötig: {1}.</translation>
    </message>
    <message>
        <source>{0} has only one trusted sample near the interval&apos;s beginning; needed: {1}.</source>
        <translation>{0} hat nahe am Anfang des Intervalls nur einen verlässlichen Messwert; nötig: {1}.</translation>
    </message>
    <message>
        <source>{0} has only one trusted sample near the interval&apos;s end; needed: {1}.</source>
        <translation>{0} hat nahe am Ende des Intervalls nur einen verlässlichen Messwert; nötig: {1}.</translation>
    </message>
    <message>
        <source>{0} has only {1} trusted samples near the interval&apos;s beginning; needed: {2}.</source>
        <translation>{0} hat nahe am Anfang des Intervalls nur {1} verlässliche Messwerte; nötig: {2}.</translation>
    </message>
    <message>
        <source>{0} has only {1} trusted samples near the interval&apos;s end; needed: {2}.</source>
        <translation>{0} hat nahe am Ende des Intervalls nur {1} verlässliche Messwerte; nötig: {2}.</translation>
    </message>
    <message>
        <source>The result would be about {0} mm off; too far to be used.</source>
        <translation>Das Ergebnis läge etwa {0} mm daneben; zu weit, um es zu verwenden.</translation>
    </message>
    <message>
        <source>The result may be {0} mm off, more than the {1} mm that it would mend.</source>
        <translation>Das Ergebnis kann {0} mm daneben liegen, mehr als die {1} mm, die es richten würde.</translation>
    </message>
    <message>
        <source>It would leave more damage than it mends: a {0} of {1} mm.</source>
        <translation>Es bliebe mehr Schaden, als es richtet: {0} von {1} mm.</translation>
    </message>
    <message>
        <source>Angles were exchanged here, not places; restoring the skeleton gives them back.</source>
        <translation>Hier wurden Winkel vertauscht, nicht Orte; das Skelett wiederherzustellen gibt sie zurück.</translation>
    </message>
    <message>
        <source>Only skeleton recordings have joints and bones.</source>
        <translation>Nur Skelettaufnahmen haben Gelenke und Knochen.</translation>
    </message>
    <message>
        <source>The joint is never seen elsewhere, so that nothing tells.</source>
        <translation>Das Gelenk ist sonst nie zu sehen, sodass nichts Aufschluss gibt.</translation>
    </message>
    <message>
        <source>{0} is not seen in these frames; there is nothing to cut.</source>
        <translation>{0} ist in diesen Frames nicht zu sehen; es gibt nichts auszuschneiden.</translation>
    </message>
    <message>
        <source>{0} is not seen in these frames; there is nothing to take over.</source>
        <translation>{0} ist in diesen Frames nicht zu sehen; es gibt nichts zu übernehmen.</translation>
    </message>
    <message>
        <source>{0} has samples of its own in {1} of these frames; cut them first, or swap the two from here to there.</source>
        <translation>{0} hat in {1} dieser Frames eigene Werte; schneiden Sie diese zuerst aus, oder tauschen Sie die beiden von hier bis dort.</translation>
    </message>
    <message>
        <source>Choose another name; these samples have this one already.</source>
        <translation>Wählen Sie einen anderen Namen; diese Werte haben diesen schon.</translation>
    </message>
    <message>
        <source>Choose two or more artifacts of one name, to join them.</source>
        <translation>Wählen Sie zwei oder mehr Artefakte desselben Namens, um sie zu verbinden.</translation>
    </message>
    <message>
        <source>Put the cursor inside the artifact, to split it there.</source>
        <translation>Setzen Sie den Cursor in das Artefakt, um es dort zu teilen.</translation>
    </message>
    <message>
        <source>That is repaired already; reopen it to undo the repair.</source>
        <translation>Das ist schon repariert; öffnen Sie es wieder, um die Reparatur zurückzunehmen.</translation>
    </message>
    <message>
        <source>This take is open in another window; close it there to edit here.</source>
        <translation>Diese Aufnahme ist in einem anderen Fenster offen; schließen Sie sie dort, um sie hier zu bearbeiten.</translation>
    </message>
    <message>
        <source>A name cannot be empty.</source>
        <translation>Ein Name darf nicht leer sein.</translation>
    </message>
    <message>
        <source>{0} frames at {1} Hz ({2} s), {3} markers. {4}, Markermend {5}.</source>
        <translation>{0} Frames mit {1} Hz ({2} s), {3} Marker. {4}, Markermend {5}.</translation>
    </message>
    <message>
        <source>{0} frames at {1} Hz ({2} s), {3} joints. {4}, Markermend {5}.</source>
        <translation>{0} Frames mit {1} Hz ({2} s), {3} Gelenke. {4}, Markermend {5}.</translation>
    </message>
    <message>
        <source>This is about frames {0}–{1} only; what lies outside is not counted.</source>
        <translation>Hier geht es nur um Frames {0}–{1}; was außerhalb liegt, ist nicht mitgezählt.</translation>
    </message>
    <message>
        <source>Detected by “{0}”</source>
        <translation>Gefunden von „{0}“</translation>
    </message>
    <message>
        <source>Searched for {0}</source>
        <translation>Gesucht: {0}</translation>
    </message>
    <message>
        <source>{0} and for {1}</source>
        <translation>{0}; außerdem {1}</translation>
    </message>
    <message>
        <source>gaps, peaks, noise and steps</source>
        <translation>Lücken, Spitzen, Rauschen und Sprünge</translation>
    </message>
    <message>
        <source>artifacts of all classes</source>
        <translation>Artefakte aller Arten</translation>
    </message>
    <message>
        <source>Missing before</source>
        <translation>Fehlte vorher</translation>
    </message>
    <message>
        <source>Missing after</source>
        <translation>Fehlt jetzt</translation>
    </message>
    <message>
        <source>Artifacts found</source>
        <translation>Artefakte gefunden</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Repariert</translation>
    </message>
    <message>
        <source>For review</source>
        <translation>Noch zu prüfen</translation>
    </message>
    <message>
        <source>Worst expected error</source>
        <translation>Größter erwarteter Fehler</translation>
    </message>
    <message>
        <source>An artifact</source>
        <translation>Je Artefakt</translation>
    </message>
    <message>
        <source>Time spent on it</source>
        <translation>Zeit dafür</translation>
    </message>
    <message>
        <source>{0} of {1}</source>
        <translation>{0} von {1}</translation>
    </message>
    <message>
        <source>Damage over time</source>
        <translation>Schäden über der Zeit</translation>
    </message>
    <message>
        <source>Worst repairs, before and after</source>
        <translation>Unsicherste Reparaturen, vorher und nachher</translation>
    </message>
    <message>
        <source>What was repaired</source>
        <translation>Was repariert wurde</translation>
    </message>
    <message>
        <source>What was left</source>
        <translation>Was blieb, wie es war</translation>
    </message>
    <message>
        <source>left</source>
        <translation>belassen</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>after, with the expected deviation where it is known</source>
        <translation>nachher, mit der erwarteten Abweichung, wo sie bekannt ist</translation>
    </message>
    <message>
        <source>Nothing is damaged as far as can be seen.</source>
        <translation>Soweit zu sehen ist, ist nichts beschädigt.</translation>
    </message>
    <message>
        <source>Found</source>
        <translation>Gefunden</translation>
    </message>
    <message>
        <source>With</source>
        <translation>Womit</translation>
    </message>
    <message>
        <source>Median expected error</source>
        <translation>Median des erwarteten Fehlers</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Frames</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Sekunden</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>Achsen</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Methode</translation>
    </message>
    <message>
        <source>Expected error</source>
        <translation>Erwarteter Fehler</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Sure</source>
        <translation>Sicher zu</translation>
    </message>
    <message>
        <source>Evidence</source>
        <translation>Anzeichen</translation>
    </message>
    <message>
        <source>Left because</source>
        <translation>Belassen, weil</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>by hand</source>
        <translation>von Hand</translation>
    </message>
    <message>
        <source>frame {0}</source>
        <translation>Frame {0}</translation>
    </message>
    <message>
        <source>{0}, expected error {1} mm</source>
        <translation>{0}, erwarteter Fehler {1} mm</translation>
    </message>
    <message>
        <source>{0}, expected error not measured</source>
        <translation>{0}, erwarteter Fehler nicht gemessen</translation>
    </message>
    <message>
        <source>Not decided yet.</source>
        <translation>Noch nicht entschieden.</translation>
    </message>
    <message>
        <source>Accepted: the flag is right, the samples are left.</source>
        <translation>Angenommen: Der Befund stimmt, die Werte bleiben.</translation>
    </message>
    <message>
        <source>Rejected as a false alarm.</source>
        <translation>Als Fehlalarm abgelehnt.</translation>
    </message>
    <message>
        <source>…and {0} more; the JSON names them all.</source>
        <translation>… und {0} weitere; das JSON nennt sie alle.</translation>
    </message>
    <message>
        <source>{0} would leave damage.</source>
        <translation>{0} würde Schäden übrig lassen.</translation>
    </message>
    <message>
        <source>Works a joint out from the others, from time, from its bones and from how bodies move; only for skeleton recordings, where it mostly is the best.</source>
        <translation>Berechnet ein Gelenk aus den anderen, aus der Zeit, aus seinen Knochen und daraus, wie Körper sich bewegen; nur für Skelettaufnahmen, wo es meist am besten ist.</translation>
    </message>
    <message>
        <source>{0} needs its skeleton: put the ASF file beside it, named {1}.asf, or choose it.</source>
        <translation>{0} braucht sein Skelett: Legen Sie die ASF-Datei als {1}.asf daneben, oder wählen Sie sie.</translation>
    </message>
    <message>
        <source>{0} needs its skeleton: none of the ASF files beside it is named {1}.asf. Name the right one so (what stands before the first _ will do, as in 02.asf for 02_01.amc), or choose it.</source>
        <translation>{0} braucht sein Skelett: Keine der ASF-Dateien daneben heißt {1}.asf. Benennen Sie die richtige so (was vor dem ersten _ steht, genügt, wie 02.asf für 02_01.amc), oder wählen Sie sie.</translation>
    </message>
    <message>
        <source>{0} needs its skeleton: {1}, the only ASF file beside it, does not have {2} as it is there. Put the right one beside it, named {3}.asf, or choose it.</source>
        <translation>{0} braucht sein Skelett: {1}, die einzige ASF-Datei daneben, hat {2} nicht so, wie es dort ist. Legen Sie die richtige als {3}.asf daneben, oder wählen Sie sie.</translation>
    </message>
    <message>
        <source>A BVH holds every joint of every pose. Frames in which joints are not known: {0}. Repair these gaps first, {repair} the one under review and {repair_accepted} all that are accepted; or write a CSV.</source>
        <translation>Eine BVH enthält jedes Gelenk jeder Pose. Frames, in denen Gelenke nicht bekannt sind: {0}. Reparieren Sie zuerst diese Lücken, mit {repair} die angezeigte und mit {repair_accepted} alle angenommenen; oder schreiben Sie eine CSV.</translation>
    </message>
    <message>
        <source>{0} rows are missing; their frames were read as gaps.</source>
        <translation>{0} Zeilen fehlen; ihre Frames wurden als Lücken gelesen.</translation>
    </message>
    <message>
        <source>Rows are out of order, or very many are missing (after row {0}, for one); those that are there were read one after the other.</source>
        <translation>Zeilen stehen nicht in ihrer Reihenfolge, oder sehr viele fehlen (etwa nach Zeile {0}); die vorhandenen wurden eine nach der anderen gelesen.</translation>
    </message>
    <message>
        <source>{0} does not fit this recording, whose joints are others or stand elsewhere, and is not used.</source>
        <translation>{0} passt nicht zu dieser Aufnahme, deren Gelenke andere sind oder anderswo stehen, und wird nicht verwendet.</translation>
    </message>
    <message>
        <source>“{0}” holds no take ending in {1}; name others, or match them as by “*.csv”.</source>
        <translation>„{0}“ enthält keine Aufnahme mit der Endung {1}; nennen Sie andere, oder wählen Sie sie mit einem Muster wie „*.csv“.</translation>
    </message>
    <message>
        <source>Found before the export</source>
        <translation>Vor dem Export gefunden</translation>
    </message>
    <message>
        <source>Decided before the export</source>
        <translation>Vor dem Export entschieden</translation>
    </message>
    <message>
        <source>Review the same frames</source>
        <translation>Dieselben Frames durchsehen</translation>
    </message>
    <message>
        <source>{0}; its residual changes there from {1} to {2}</source>
        <translation>{0}; sein Residuum ändert sich dort von {1} auf {2}</translation>
    </message>
    <message>
        <source>stands up to {0} from where the rest of the body has it, for {1}</source>
        <translation>steht bis zu {0} von der Stelle entfernt, an die es nach dem übrigen Körper gehört, {1} lang</translation>
    </message>
    <message>
        <source>has its angles exchanged with those of {0}, for {1}</source>
        <translation>Winkel mit denen von {0} vertauscht, {1} lang</translation>
    </message>
    <message>
        <source>is carried off with the whole body, by up to {0}, for {1}</source>
        <translation>ist mit dem ganzen Körper um bis zu {0} versetzt, {1} lang</translation>
    </message>
    <message>
        <source>Worked out from other repairs; look at it closely. Without them: {0}</source>
        <translation>Aus anderen Reparaturen berechnet; bitte genau ansehen. Ohne sie: {0}</translation>
    </message>
    <message>
        <source>Already exchanged together with {0}.</source>
        <translation>Schon zusammen mit {0} getauscht.</translation>
    </message>
    <message>
        <source>No counterpart is known that carries the opposite step.</source>
        <translation>Kein Gegenstück mit dem entgegengesetzten Sprung ist bekannt.</translation>
    </message>
    <message>
        <source>No bone of this recording was ever seen whole; a joint and the one that it hangs on must be seen in one pose.</source>
        <translation>Kein Knochen dieser Aufnahme war je ganz zu sehen; ein Gelenk und das, an dem es hängt, müssen in einer Pose zu sehen sein.</translation>
    </message>
    <message>
        <source>The recording is too short: it takes {0} poses, and has {1}; take a longer one.</source>
        <translation>Die Aufnahme ist zu kurz: Es braucht {0} Posen, sie hat {1}; nehmen Sie eine längere.</translation>
    </message>
    <message>
        <source>There is no signal to smooth inside a gap.</source>
        <translation>In einer Lücke gibt es kein Signal zu glätten.</translation>
    </message>
    <message>
        <source>The interval is empty already.</source>
        <translation>Das Intervall ist schon leer.</translation>
    </message>
    <message>
        <source>Edited by hand since; how far off it may be is not known any more.</source>
        <translation>Seither von Hand bearbeitet; wie weit sie daneben liegen kann, ist nicht mehr bekannt.</translation>
    </message>
    <message>
        <source>Smoothed since; the expected error is that of the repair.</source>
        <translation>Seither geglättet; der erwartete Fehler ist der der Reparatur.</translation>
    </message>
    <message>
        <source>{0} Smoothed since; the expected error is that of the repair.</source>
        <translation>{0} Seither geglättet; der erwartete Fehler ist der der Reparatur.</translation>
    </message>
    <message>
        <source>The detector still finds damage there: a {0} of {1} mm.</source>
        <translation>Der Detektor findet dort noch Schäden: {0} von {1} mm.</translation>
    </message>
    <message>
        <source>The detector still finds damage there: a {0} of {1} mm and {2} more.</source>
        <translation>Der Detektor findet dort noch Schäden: {0} von {1} mm und {2} weitere.</translation>
    </message>
    <message>
        <source>There is a “{0}” already; choose another name.</source>
        <translation>Es gibt schon „{0}“; bitte einen anderen Namen wählen.</translation>
    </message>
    <message>
        <source>{0} frames ({1})</source>
        <translation>{0} Frames ({1})</translation>
    </message>
    <message>
        <source>{0} frame ({1})</source>
        <translation>{0} Frame ({1})</translation>
    </message>
    <message>
        <source>Processor</source>
        <translation>Prozessor</translation>
    </message>
    <message>
        <source>Storage</source>
        <translation>Speicherung</translation>
    </message>
    <message>
        <source>Units</source>
        <translation>Einheiten</translation>
    </message>
    <message>
        <source>Missing samples</source>
        <translation>Fehlende Werte</translation>
    </message>
    <message>
        <source>Force plates</source>
        <translation>Kraftmessplatten</translation>
    </message>
    <message>
        <source>Step mm</source>
        <translation>Schritt mm</translation>
    </message>
    <message>
        <source>Manufacturer</source>
        <translation>Hersteller</translation>
    </message>
    <message>
        <source>Software</source>
        <translation>Software</translation>
    </message>
    <message>
        <source>Version</source>
        <translation>Version</translation>
    </message>
    <message>
        <source>head</source>
        <translation>Kopf</translation>
    </message>
    <message>
        <source>trunk</source>
        <translation>Rumpf</translation>
    </message>
    <message>
        <source>shoulder</source>
        <translation>Schulter</translation>
    </message>
    <message>
        <source>pelvis</source>
        <translation>Becken</translation>
    </message>
    <message>
        <source>upper arm</source>
        <translation>Oberarm</translation>
    </message>
    <message>
        <source>forearm</source>
        <translation>Unterarm</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>Hand</translation>
    </message>
    <message>
        <source>thigh</source>
        <translation>Oberschenkel</translation>
    </message>
    <message>
        <source>shank</source>
        <translation>Unterschenkel</translation>
    </message>
    <message>
        <source>foot</source>
        <translation>Fuß</translation>
    </message>
    <message>
        <source>Left {0}</source>
        <translation>{0} links</translation>
    </message>
    <message>
        <source>Right {0}</source>
        <translation>{0} rechts</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Bereiche</translation>
    </message>
    <message>
        <source>Plots</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>recent take</source>
        <translation>zuletzt geöffnet</translation>
    </message>
    <message>
        <source>shown</source>
        <translation>gezeigt</translation>
    </message>
    <message>
        <source>Markers in one colour</source>
        <translation>Marker in einer Farbe</translation>
    </message>
    <message>
        <source>Joints in one colour</source>
        <translation>Gelenke in einer Farbe</translation>
    </message>
    <message>
        <source>Coloured by group</source>
        <translation>Farbe nach Gruppe</translation>
    </message>
    <message>
        <source>Coloured by damage</source>
        <translation>Farbe nach Schaden</translation>
    </message>
    <message>
        <source>Ghost of the other version</source>
        <translation>Geist der anderen Fassung</translation>
    </message>
    <message>
        <source>Segments of wrong length in red</source>
        <translation>Segmente falscher Länge in Rot</translation>
    </message>
    <message>
        <source>Axis that points up</source>
        <translation>Achse nach oben</translation>
    </message>
    <message>
        <source>As the take suggests</source>
        <translation>Wie es die Aufnahme nahelegt</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Whole take</source>
        <translation>Ganze Aufnahme</translation>
    </message>
    <message>
        <source>Marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Click to see it in the plots, double-click for its worst artifact</source>
        <translation>Klick zeigt ihn in den Kurven, Doppelklick sein schlimmstes Artefakt</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Artifacts to be decided, by class</source>
        <translation>Noch zu entscheidende Artefakte nach Art</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>Fehlt</translation>
    </message>
    <message>
        <source>Share of frames in which the file has no sample</source>
        <translation>Anteil der Frames, für die die Datei keinen Wert hat</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Share of frames without a sample as the take stands</source>
        <translation>Anteil der Frames ohne Wert, so wie die Aufnahme jetzt ist</translation>
    </message>
    <message>
        <source>Mended</source>
        <translation>Repariert</translation>
    </message>
    <message>
        <source>Share of frames that were filled or edited</source>
        <translation>Anteil der Frames, die gefüllt oder bearbeitet wurden</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Mean expected error of the repairs, each counted by its length</source>
        <translation>Mittlerer erwarteter Fehler der Reparaturen, jede nach ihrer Länge gezählt</translation>
    </message>
    <message>
        <source>Largest expected error of a repair</source>
        <translation>Größter erwarteter Fehler einer Reparatur</translation>
    </message>
    <message>
        <source>Worst</source>
        <translation>Größter</translation>
    </message>
    <message>
        <source>Decided</source>
        <translation>Entschieden</translation>
    </message>
    <message>
        <source>Artifacts accepted, rejected or repaired, by class</source>
        <translation>Angenommene, abgelehnte oder reparierte Artefakte nach Art</translation>
    </message>
    <message>
        <source>On {0}</source>
        <translation>Auf {0}</translation>
    </message>
    <message>
        <source>In the whole take</source>
        <translation>In der ganzen Aufnahme</translation>
    </message>
    <message>
        <source>In the group {0}</source>
        <translation>In der Gruppe {0}</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>not searched</source>
        <translation>nicht durchsucht</translation>
    </message>
    <message>
        <source>exported</source>
        <translation>exportiert</translation>
    </message>
    <message>
        <source>{0:.1f} % missing</source>
        <translation>{0:.1f} % fehlen</translation>
    </message>
    <message>
        <source>Missing {0:.2%}, in the file {1:.2%}; mended {2:.2%}</source>
        <translation>Fehlend {0:.2%}, in der Datei {1:.2%}; ausgebessert {2:.2%}</translation>
    </message>
    <message>
        <source>Largest expected error of a repair: {0}</source>
        <translation>Größter erwarteter Fehler einer Reparatur: {0}</translation>
    </message>
    <message>
        <source>{0}: {1} open, {2} decided</source>
        <translation>{0}: {1} offen, {2} entschieden</translation>
    </message>
    <message>
        <source>Exported as it stands.</source>
        <translation>So exportiert, wie er steht.</translation>
    </message>
    <message>
        <source>Made ready: it opens at once.</source>
        <translation>Vorbereitet: Sie öffnet sich sofort.</translation>
    </message>
    <message>
        <source>None yet</source>
        <translation>Noch keine</translation>
    </message>
    <message>
        <source>{0} on {1}</source>
        <translation>{0} an {1}</translation>
    </message>
    <message>
        <source>{0} and {1}</source>
        <translation>{0} und {1}</translation>
    </message>
    <message>
        <source>Sort by</source>
        <translation>Sortieren nach</translation>
    </message>
    <message>
        <source>Takes</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Alle Dateien</translation>
    </message>
    <message>
        <source>Skeleton recordings</source>
        <translation>Skelettaufnahmen</translation>
    </message>
    <message>
        <source>No take is open</source>
        <translation>Keine Aufnahme ist offen</translation>
    </message>
    <message>
        <source>Open a take, or drop one onto the window.</source>
        <translation>Eine Aufnahme öffnen oder auf das Fenster ziehen.</translation>
    </message>
    <message>
        <source>There is nothing in it to be shown or mended.</source>
        <translation>Sie enthält nichts zu zeigen oder zu reparieren.</translation>
    </message>
    <message>
        <source>Check the channels in the tree that are to be seen.</source>
        <translation>Im Baum die Kanäle ankreuzen, die gezeigt werden sollen.</translation>
    </message>
    <message>
        <source>This file has no markers</source>
        <translation>Diese Datei enthält keine Marker</translation>
    </message>
    <message>
        <source>Check joints in the tree, or go to an artifact in the review queue.</source>
        <translation>Gelenke im Baum ankreuzen oder zu einem Artefakt der Prüfliste gehen.</translation>
    </message>
    <message>
        <source>No joint is shown</source>
        <translation>Kein Gelenk wird gezeigt</translation>
    </message>
    <message>
        <source>Check markers in the tree, or go to an artifact in the review queue.</source>
        <translation>Marker im Baum ankreuzen oder zu einem Artefakt der Prüfliste gehen.</translation>
    </message>
    <message>
        <source>No marker is shown</source>
        <translation>Kein Marker wird gezeigt</translation>
    </message>
    <message>
        <source> – {0} in mm</source>
        <translation> – {0} in mm</translation>
    </message>
    <message>
        <source>Analog</source>
        <translation>Analog</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Moment</source>
        <translation>Moment</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Leistung</translation>
    </message>
    <message>
        <source>Scalar</source>
        <translation>Skalar</translation>
    </message>
    <message>
        <source>Reaction</source>
        <translation>Reaktion</translation>
    </message>
    <message>
        <source>Point of the model</source>
        <translation>Punkt des Modells</translation>
    </message>
    <message>
        <source>L/R {0}</source>
        <translation>L/R {0}</translation>
    </message>
    <message>
        <source>Swap joints</source>
        <translation>Gelenke tauschen</translation>
    </message>
    <message>
        <source>Choose the skeleton of {0}</source>
        <translation>Skelett von {0} wählen</translation>
    </message>
    <message>
        <source>Look from</source>
        <translation>Sehen von</translation>
    </message>
    <message>
        <source>above</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>below</source>
        <translation>unten</translation>
    </message>
    <message>
        <source>keypad {0}</source>
        <translation>Ziffernblock {0}</translation>
    </message>
    <message>
        <source>camera view front back side top bottom</source>
        <translation>Kamera Ansicht vorn hinten Seite oben unten</translation>
    </message>
</context>
<context>
    <name>AlikeDialog</name>
    <message>
        <source>Repair all like this: {0}</source>
        <translation>Alle ähnlichen reparieren: {0}</translation>
    </message>
    <message>
        <source>Reject all like this: {0}</source>
        <translation>Alle ähnlichen ablehnen: {0}</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>At least this sure</source>
        <translation>Mindestens so sicher</translation>
    </message>
    <message>
        <source>Marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Frames</translation>
    </message>
    <message>
        <source>Sure</source>
        <translation>Sicher</translation>
    </message>
    <message>
        <source>What will happen</source>
        <translation>Was geschehen wird</translation>
    </message>
    <message>
        <source>rejected as a false alarm, left as it is</source>
        <translation>als Fehlalarm abgelehnt, bleibt, wie es ist</translation>
    </message>
    <message>
        <source>working it out…</source>
        <translation>wird berechnet…</translation>
    </message>
    <message>
        <source>left as it is: {0}</source>
        <translation>bleibt, wie es ist: {0}</translation>
    </message>
    <message>
        <source>Repair {0}</source>
        <translation>{0} reparieren</translation>
    </message>
    <message>
        <source>Reject {0}</source>
        <translation>{0} ablehnen</translation>
    </message>
    <message>
        <source>No open artifact is like this; look further or be less strict.</source>
        <translation>Kein offenes Artefakt ist ähnlich; weiter suchen oder weniger streng sein.</translation>
    </message>
    <message>
        <source>Working out {0} repairs…</source>
        <translation>{0} Reparaturen werden berechnet…</translation>
    </message>
    <message>
        <source>Working out 1 repair…</source>
        <translation>1 Reparatur wird berechnet…</translation>
    </message>
    <message>
        <source>One step, undone by {0}.</source>
        <translation>Ein Schritt, den {0} zurücknimmt.</translation>
    </message>
    <message>
        <source>{0} are left as they are.</source>
        <translation>{0} bleiben, wie sie sind.</translation>
    </message>
    <message>
        <source>1 is left as it is.</source>
        <translation>1 bleibt, wie es ist.</translation>
    </message>
</context>
<context>
    <name>ArtifactPage</name>
    <message>
        <source>Class</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Class of the artifact</source>
        <translation>Art des Artefakts</translation>
    </message>
    <message>
        <source>Whether {0} is wrong</source>
        <translation>Ob {0} falsch ist</translation>
    </message>
    <message>
        <source>Axis {0}</source>
        <translation>Achse {0}</translation>
    </message>
    <message>
        <source>First frame</source>
        <translation>Erster Frame</translation>
    </message>
    <message>
        <source>Last frame</source>
        <translation>Letzter Frame</translation>
    </message>
    <message>
        <source>{0}, as numbered in the file</source>
        <translation>{0}, wie in der Datei gezählt</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Sicherheit</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Frames</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Whole body</source>
        <translation>Ganzer Körper</translation>
    </message>
    <message>
        <source>outside the region of interest</source>
        <translation>außerhalb des Ausschnitts</translation>
    </message>
    <message>
        <source>Frames {0}</source>
        <translation>Frames {0}</translation>
    </message>
    <message>
        <source>Frame {0}</source>
        <translation>Frame {0}</translation>
    </message>
    <message>
        <source>No reason was given.</source>
        <translation>Es wurde kein Grund angegeben.</translation>
    </message>
    <message>
        <source>certain: nothing was recorded</source>
        <translation>sicher: nichts aufgezeichnet</translation>
    </message>
    <message>
        <source>marked by hand</source>
        <translation>von Hand markiert</translation>
    </message>
    <message>
        <source>made by hand</source>
        <translation>von Hand gemacht</translation>
    </message>
    <message>
        <source>nearly certain</source>
        <translation>fast sicher</translation>
    </message>
    <message>
        <source>likely</source>
        <translation>wahrscheinlich</translation>
    </message>
    <message>
        <source>possible</source>
        <translation>möglich</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>zweifelhaft</translation>
    </message>
    <message>
        <source>Repaired: {0}</source>
        <translation>Repariert: {0}</translation>
    </message>
    <message>
        <source>Open: not decided yet</source>
        <translation>Offen: noch nicht entschieden</translation>
    </message>
    <message>
        <source>Accepted: to be repaired</source>
        <translation>Angenommen: zu reparieren</translation>
    </message>
    <message>
        <source>Rejected: a false alarm</source>
        <translation>Abgelehnt: ein Fehlalarm</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Repariert</translation>
    </message>
</context>
<context>
    <name>BatchReview</name>
    <message>
        <source>List of a batch</source>
        <translation>Liste einer Serie</translation>
    </message>
    <message>
        <source>Review a batch: takes, or the review.json of a batch</source>
        <translation>Eine Serie durchsehen: Aufnahmen, oder die review.json einer Serie</translation>
    </message>
    <message>
        <source>Review the takes of a folder, or what a batch wrote to it</source>
        <translation>Die Aufnahmen eines Ordners durchsehen, oder was eine Serie in ihn schrieb</translation>
    </message>
    <message>
        <source>All takes of the list are done.</source>
        <translation>Alle Aufnahmen der Liste sind fertig.</translation>
    </message>
    <message>
        <source>No artifact of this batch waits for an operator.</source>
        <translation>Kein Artefakt dieser Serie wartet auf eine Entscheidung.</translation>
    </message>
    <message>
        <source>Looking for takes</source>
        <translation>Suche nach Aufnahmen</translation>
    </message>
    <message>
        <source>All other takes of the list are done.</source>
        <translation>Alle anderen Aufnahmen der Liste sind fertig.</translation>
    </message>
    <message>
        <source>No takes are listed; File: Review a batch lists some.</source>
        <translation>Es sind keine Aufnahmen aufgelistet; Datei: Eine Serie durchsehen listet welche auf.</translation>
    </message>
    <message>
        <source>Everything is decided, in all takes of the list.</source>
        <translation>Alles ist entschieden, in allen Aufnahmen der Liste.</translation>
    </message>
    <message>
        <source>Everything is decided. {0} goes on with {1}.</source>
        <translation>Alles ist entschieden. {0} geht weiter mit {1}.</translation>
    </message>
</context>
<context>
    <name>Bulk</name>
    <message>
        <source>1 artifact comes last now.</source>
        <translation>1 Artefakt kommt jetzt zuletzt.</translation>
    </message>
    <message>
        <source>{0} artifacts come last now.</source>
        <translation>{0} Artefakte kommen jetzt zuletzt.</translation>
    </message>
    <message>
        <source>In the region of interest</source>
        <translation>Im Ausschnitt</translation>
    </message>
    <message>
        <source>{0} repaired.</source>
        <translation>{0} repariert.</translation>
    </message>
    <message>
        <source>{0} rejected.</source>
        <translation>{0} abgelehnt.</translation>
    </message>
</context>
<context>
    <name>Candidates</name>
    <message>
        <source>Repairs compared</source>
        <translation>Reparaturen im Vergleich</translation>
    </message>
    <message>
        <source>Working out what every method would do…</source>
        <translation>Es wird berechnet, was jedes Verfahren täte…</translation>
    </message>
    <message>
        <source>This is repaired already; {0} takes that back.</source>
        <translation>Dies ist schon repariert; {0} nimmt es zurück.</translation>
    </message>
    <message>
        <source>No method has an answer here.</source>
        <translation>Kein Verfahren hat hier eine Antwort.</translation>
    </message>
    <message>
        <source>↑ ↓ choose, {0} repairs. ± is judged by like stretches in sight.</source>
        <translation>↑ ↓ wählen, {0} repariert. ± ist an ähnlichen gesehenen Strecken geschätzt.</translation>
    </message>
    <message>
        <source>↑ ↓ choose, {0} repairs. ± is each method&apos;s own estimate; Restore skeleton comes first unless another is clearly surer.</source>
        <translation>↑ ↓ wählen, {0} repariert. ± schätzt jedes Verfahren selbst; „Skelett wiederherstellen“ steht vorn, wenn kein anderes deutlich sicherer ist.</translation>
    </message>
    <message>
        <source>1 other method has no answer here.</source>
        <translation>1 weiteres Verfahren hat hier keine Antwort.</translation>
    </message>
    <message>
        <source>{0} other methods have no answer here.</source>
        <translation>{0} weitere Verfahren haben hier keine Antwort.</translation>
    </message>
</context>
<context>
    <name>Centring</name>
    <message>
        <source>Joint centres</source>
        <translation>Gelenkzentren</translation>
    </message>
    <message>
        <source>From all frames of the take as it stands.</source>
        <translation>Aus allen Frames der Aufnahme, wie sie jetzt ist.</translation>
    </message>
    <message>
        <source>From frames {0}–{1} of the take as it stands, the region of interest.</source>
        <translation>Aus den Frames {0}–{1} der Aufnahme, wie sie jetzt ist: dem Ausschnitt.</translation>
    </message>
    <message>
        <source>1 artifact is not repaired. Damage pulls joint centres along.</source>
        <translation>1 Artefakt ist nicht repariert. Schäden ziehen Gelenkzentren mit.</translation>
    </message>
    <message>
        <source>{0} artifacts are not repaired. Damage pulls joint centres along.</source>
        <translation>{0} Artefakte sind nicht repariert. Schäden ziehen Gelenkzentren mit.</translation>
    </message>
    <message>
        <source>Joint centres written to {0}.</source>
        <translation>Gelenkzentren nach {0} geschrieben.</translation>
    </message>
    <message>
        <source>Save joint centres</source>
        <translation>Gelenkzentren speichern</translation>
    </message>
    <message>
        <source>{0} is the take itself; choose another name.</source>
        <translation>{0} ist die Aufnahme selbst; wählen Sie einen anderen Namen.</translation>
    </message>
</context>
<context>
    <name>Commands</name>
    <message>
        <source>Open take</source>
        <translation>Aufnahme öffnen</translation>
    </message>
    <message>
        <source>Opening {0}</source>
        <translation>{0} wird geöffnet</translation>
    </message>
    <message>
        <source>Looking at the body</source>
        <translation>Der Körper wird betrachtet</translation>
    </message>
    <message>
        <source>Undone: {0}</source>
        <translation>Rückgängig gemacht: {0}</translation>
    </message>
    <message>
        <source>Done again: {0}</source>
        <translation>Wiederholt: {0}</translation>
    </message>
    <message>
        <source>{0} joints, {1} frames at {2:g} Hz.</source>
        <translation>{0} Gelenke, {1} Frames mit {2:g} Hz.</translation>
    </message>
    <message>
        <source>{0} markers, {1} frames at {2:g} Hz.</source>
        <translation>{0} Marker, {1} Frames mit {2:g} Hz.</translation>
    </message>
    <message>
        <source>1 marker, {1} frames at {2:g} Hz.</source>
        <translation>1 Marker, {1} Frames mit {2:g} Hz.</translation>
    </message>
    <message>
        <source>It was open in another window: this one is read-only. To review here, close that one and open the take again.</source>
        <translation>Sie war in einem anderen Fenster offen: Hier wird nur gelesen. Um sie hier durchzusehen, schließen Sie jenes und öffnen Sie die Aufnahme erneut.</translation>
    </message>
    <message>
        <source>An interrupted review was recovered; last step: {0}.</source>
        <translation>Eine abgebrochene Durchsicht wurde wiederhergestellt; letzter Schritt: {0}.</translation>
    </message>
    <message>
        <source>opened</source>
        <translation>geöffnet</translation>
    </message>
</context>
<context>
    <name>Comparison</name>
    <message>
        <source>Hold the key until the repairs to compare are there.</source>
        <translation>Taste halten, bis die Reparaturen zum Vergleichen da sind.</translation>
    </message>
</context>
<context>
    <name>Decisions</name>
    <message>
        <source>Accept</source>
        <translation>Annehmen</translation>
    </message>
    <message>
        <source>The flag is right; the samples stay for now</source>
        <translation>Der Befund stimmt; die Werte bleiben vorerst</translation>
    </message>
    <message>
        <source>Reject</source>
        <translation>Ablehnen</translation>
    </message>
    <message>
        <source>A false alarm, never touched</source>
        <translation>Ein Fehlalarm, wird nie angerührt</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>Replace the samples by the repair shown</source>
        <translation>Die Werte durch die gezeigte Reparatur ersetzen</translation>
    </message>
    <message>
        <source>Reopen</source>
        <translation>Wieder öffnen</translation>
    </message>
    <message>
        <source>Take the decision back</source>
        <translation>Die Entscheidung zurücknehmen</translation>
    </message>
    <message>
        <source>{0} repaired.</source>
        <translation>{0} repariert.</translation>
    </message>
    <message>
        <source>The flag on {0} is accepted, the samples are left. {1}</source>
        <translation>Der Befund an {0} ist angenommen, die Werte bleiben. {1}</translation>
    </message>
    <message>
        <source>{0} on {1} is open again: its repair was for what it was before.</source>
        <translation>{0} an {1} ist wieder offen: die Reparatur galt dem, was es vorher war.</translation>
    </message>
</context>
<context>
    <name>Detecting</name>
    <message>
        <source>Markers were renamed meanwhile; detect again.</source>
        <translation>Inzwischen wurden Marker umbenannt; bitte erneut suchen.</translation>
    </message>
    <message>
        <source>Joints were renamed meanwhile; detect again.</source>
        <translation>Inzwischen wurden Gelenke umbenannt; bitte erneut suchen.</translation>
    </message>
    <message>
        <source>1 artifact found.</source>
        <translation>1 Artefakt gefunden.</translation>
    </message>
    <message>
        <source>{0} artifacts found.</source>
        <translation>{0} Artefakte gefunden.</translation>
    </message>
    <message>
        <source>In the region of interest: {0}.</source>
        <translation>Im Ausschnitt: {0}.</translation>
    </message>
    <message>
        <source>Looking for artifacts</source>
        <translation>Suche nach Artefakten</translation>
    </message>
</context>
<context>
    <name>ExportDialog</name>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Nothing was found or marked. Export the take as it is?</source>
        <translation>Nichts wurde gefunden oder markiert. Die Aufnahme exportieren, wie sie ist?</translation>
    </message>
    <message>
        <source>Export repairs nothing by itself: only what you repaired differs.</source>
        <translation>Der Export repariert nichts von selbst: Nur was Sie repariert haben, unterscheidet sich.</translation>
    </message>
    <message>
        <source>Model outputs in this file (angles, forces, moments…) were computed from the markers before their repair and no longer match: {0}.</source>
        <translation>Modellausgaben in dieser Datei (Winkel, Kräfte, Momente…) wurden aus den Markern vor der Reparatur berechnet und passen nicht mehr: {0}.</translation>
    </message>
    <message>
        <source>Write into a C3D file what was repaired, and how</source>
        <translation>In eine C3D-Datei schreiben, was wie repariert wurde</translation>
    </message>
    <message>
        <source>Name in the file the model outputs that no longer match</source>
        <translation>In der Datei die Modellausgaben nennen, die nicht mehr passen</translation>
    </message>
    <message>
        <source>Write frames {0}–{1} only, the region of interest</source>
        <translation>Nur Frames {0}–{1} schreiben, den Ausschnitt</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Exportieren…</translation>
    </message>
    <message>
        <source>Show list</source>
        <translation>Liste zeigen</translation>
    </message>
    <message>
        <source>{0} not decided</source>
        <translation>{0} nicht entschieden</translation>
    </message>
    <message>
        <source>{0} accepted but not repaired</source>
        <translation>{0} angenommen, aber nicht repariert</translation>
    </message>
    <message>
        <source>Every artifact is decided. Export?</source>
        <translation>Jedes Artefakt ist entschieden. Exportieren?</translation>
    </message>
    <message>
        <source>Export with artifacts left as they are: {0}?</source>
        <translation>Exportieren, obwohl Artefakte bleiben: {0}?</translation>
    </message>
</context>
<context>
    <name>Exporter</name>
    <message>
        <source>A part of {0} cannot replace it; choose another name.</source>
        <translation>Ein Teil von {0} kann es nicht ersetzen; wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>Exporting {0}</source>
        <translation>{0} wird exportiert</translation>
    </message>
    <message>
        <source>{0} was not written.</source>
        <translation>{0} wurde nicht geschrieben.</translation>
    </message>
    <message>
        <source>Exported to {0}; 1 sample differs.</source>
        <translation>Nach {0} exportiert; 1 Wert unterscheidet sich.</translation>
    </message>
    <message>
        <source>Exported to {0}; {1} samples differ.</source>
        <translation>Nach {0} exportiert; {1} Werte unterscheiden sich.</translation>
    </message>
    <message>
        <source>Its bones are rigid: {0} is {1} off there, no joint is more.</source>
        <translation>Die Knochen sind starr: {0} liegt dort {1} daneben, kein Gelenk weiter.</translation>
    </message>
    <message>
        <source>The original is kept as {0}.</source>
        <translation>Das Original bleibt als {0} erhalten.</translation>
    </message>
    <message>
        <source>It was written anew, so without further columns of its source: {0}.</source>
        <translation>Die Datei wurde neu geschrieben, daher ohne weitere Spalten der Quelle: {0}.</translation>
    </message>
    <message>
        <source>Export repaired take</source>
        <translation>Reparierte Aufnahme exportieren</translation>
    </message>
</context>
<context>
    <name>FloatingButtons</name>
    <message>
        <source>Decide about this artifact</source>
        <translation>Über dieses Artefakt entscheiden</translation>
    </message>
    <message>
        <source>Accept: the flag is right</source>
        <translation>Annehmen: Der Befund stimmt</translation>
    </message>
    <message>
        <source>Reject: a false alarm</source>
        <translation>Ablehnen: ein Fehlalarm</translation>
    </message>
    <message>
        <source>Repair: replace the samples as shown</source>
        <translation>Reparieren: die Werte wie gezeigt ersetzen</translation>
    </message>
</context>
<context>
    <name>HandWork</name>
    <message>
        <source>Repairing</source>
        <translation>Reparatur</translation>
    </message>
    <message>
        <source>Rename {0}</source>
        <translation>{0} umbenennen</translation>
    </message>
    <message>
        <source>Swap {0} with which marker, {1}?</source>
        <translation>Mit welchem Marker {0} tauschen, {1}?</translation>
    </message>
    <message>
        <source>Swap {0} with which joint, {1}?</source>
        <translation>Mit welchem Gelenk {0} tauschen, {1}?</translation>
    </message>
    <message>
        <source>jumps {0} at the edges</source>
        <translation>springt {0} an den Rändern</translation>
    </message>
    <message>
        <source>Which marker is {0} in truth, {1}?</source>
        <translation>Welcher Marker ist {0} in Wahrheit, {1}?</translation>
    </message>
    <message>
        <source>Which joint is {0} in truth, {1}?</source>
        <translation>Welches Gelenk ist {0} in Wahrheit, {1}?</translation>
    </message>
    <message>
        <source>Which unlabelled trajectory belongs to {0}?</source>
        <translation>Welche unbenannte Trajektorie gehört zu {0}?</translation>
    </message>
    <message>
        <source>{0} away</source>
        <translation>{0} entfernt</translation>
    </message>
    <message>
        <source>Merge {0} into which joint?</source>
        <translation>{0} mit welchem Gelenk zusammenführen?</translation>
    </message>
    <message>
        <source>Merge {0} into which marker?</source>
        <translation>{0} mit welchem Marker zusammenführen?</translation>
    </message>
    <message>
        <source>The next artifact of {0} begins {1} frames later; select both in the queue to join them.</source>
        <translation>Das nächste Artefakt von {0} beginnt {1} Frames später; wählen Sie beide in der Liste aus, um sie zu verbinden.</translation>
    </message>
    <message>
        <source>{0}.</source>
        <translation>{0}.</translation>
    </message>
    <message>
        <source>The review changed meanwhile; do it again.</source>
        <translation>Die Durchsicht hat sich inzwischen geändert; bitte noch einmal.</translation>
    </message>
    <message>
        <source>No other marker is missing wherever {0} is seen; to exchange two, swap.</source>
        <translation>Kein anderer Marker fehlt überall dort, wo {0} zu sehen ist; um zwei auszutauschen, tauschen.</translation>
    </message>
    <message>
        <source>No other joint is missing wherever {0} is seen; to exchange two, swap.</source>
        <translation>Kein anderes Gelenk fehlt überall dort, wo {0} zu sehen ist; um zwei auszutauschen, tauschen.</translation>
    </message>
    <message>
        <source>frames {0}–{1}</source>
        <translation>Frames {0}–{1}</translation>
    </message>
</context>
<context>
    <name>HistoryPanel</name>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Click a step to go there; it is undone and done again in order.</source>
        <translation>Auf einen Schritt klicken, um dorthin zu gehen; dazwischen wird der Reihe nach zurückgenommen oder wiederholt.</translation>
    </message>
    <message>
        <source>What you do appears here; every step can be undone.</source>
        <translation>Was Sie tun, erscheint hier; jeder Schritt lässt sich zurücknehmen.</translation>
    </message>
</context>
<context>
    <name>Inspector</name>
    <message>
        <source>Open a take to see its details here.</source>
        <translation>Eine Aufnahme öffnen, um hier ihre Einzelheiten zu sehen.</translation>
    </message>
    <message>
        <source>{0} on {1} is under review, behind the swept range. Press again to decide.</source>
        <translation>{0} an {1} ist in Durchsicht, hinter dem überstrichenen Bereich. Zum Entscheiden noch einmal drücken.</translation>
    </message>
</context>
<context>
    <name>JointCentresDialog</name>
    <message>
        <source>Joint centres</source>
        <translation>Gelenkzentren</translation>
    </message>
    <message>
        <source>They are saved as a skeleton recording, a CSV of joints. Error and Doubt are not in it: copy the table to keep them.</source>
        <translation>Sie werden als Skelettaufnahme gespeichert, eine CSV von Gelenken. Fehler und Unsicherheit stehen nicht darin: Kopieren Sie die Tabelle, um sie zu behalten.</translation>
    </message>
    <message>
        <source>Joint between</source>
        <translation>Gelenk zwischen</translation>
    </message>
    <message>
        <source>The two rigid groups that it joins</source>
        <translation>Die beiden starren Gruppen, die es verbindet</translation>
    </message>
    <message>
        <source>Error, {0}</source>
        <translation>Fehler, {0}</translation>
    </message>
    <message>
        <source>How far apart the two groups carry the centre, root mean square</source>
        <translation>Wie weit auseinander beide Gruppen das Zentrum tragen, quadratisches Mittel</translation>
    </message>
    <message>
        <source>Doubt, {0}</source>
        <translation>Unsicherheit, {0}</translation>
    </message>
    <message>
        <source>How far the centre could move, where the movement tells least, until the squared error doubles; a bound rather than an expectation</source>
        <translation>Wie weit sich das Zentrum verschieben ließe, wo die Bewegung am wenigsten verrät, bis sich der quadrierte Fehler verdoppelt; eher eine Grenze als eine Erwartung</translation>
    </message>
    <message>
        <source>Least turning, °</source>
        <translation>Geringste Drehung, °</translation>
    </message>
    <message>
        <source>How much the groups turn about the axis about which they turn least</source>
        <translation>Wie sehr sich die Gruppen um die Achse drehen, um die sie sich am wenigsten drehen</translation>
    </message>
    <message>
        <source>Told by</source>
        <translation>Bestimmt durch</translation>
    </message>
    <message>
        <source>What tells where along its axis the centre of a hinge is</source>
        <translation>Was verrät, wo auf seiner Achse das Zentrum eines Scharniers liegt</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Speichern…</translation>
    </message>
    <message>
        <source>Save and open…</source>
        <translation>Speichern und öffnen…</translation>
    </message>
    <message>
        <source>Save, and open the joints here in place of this take</source>
        <translation>Speichern und die Gelenke hier anstelle dieser Aufnahme öffnen</translation>
    </message>
    <message>
        <source>Copy table</source>
        <translation>Tabelle kopieren</translation>
    </message>
    <message>
        <source>Working out joint centres</source>
        <translation>Gelenkzentren werden bestimmt</translation>
    </message>
    <message>
        <source>No joint centres</source>
        <translation>Keine Gelenkzentren</translation>
    </message>
    <message>
        <source>1 joint found</source>
        <translation>1 Gelenk gefunden</translation>
    </message>
    <message>
        <source>{0} joints found</source>
        <translation>{0} Gelenke gefunden</translation>
    </message>
    <message>
        <source>, {0} left out</source>
        <translation>, {0} ausgelassen</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Ausgelassen</translation>
    </message>
</context>
<context>
    <name>KeptListed</name>
    <message>
        <source>No artifact is listed, so that none is under review.</source>
        <translation>Kein Artefakt ist aufgeführt, daher ist keines in Durchsicht.</translation>
    </message>
</context>
<context>
    <name>KeySweep</name>
    <message>
        <source>Move the cursor to where the selection ends, then press again</source>
        <translation>Den Cursor dorthin bewegen, wo die Auswahl endet, dann noch einmal drücken</translation>
    </message>
</context>
<context>
    <name>Legend</name>
    <message>
        <source>Bring {marker} to the front</source>
        <translation>{marker} nach vorn holen</translation>
    </message>
</context>
<context>
    <name>MainWindow</name>
    <message>
        <source>Markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Takes</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Einzelheiten</translation>
    </message>
    <message>
        <source>Review queue</source>
        <translation>Prüfliste</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Toolbar</source>
        <translation>Werkzeugleiste</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Detect</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>Prediction</source>
        <translation>Vorhersage</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Bereiche</translation>
    </message>
    <message>
        <source>Recent takes</source>
        <translation>Letzte Aufnahmen</translation>
    </message>
    <message>
        <source>take</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source> (read-only)</source>
        <translation> (nur lesen)</translation>
    </message>
</context>
<context>
    <name>Manual</name>
    <message>
        <source>Markermend&apos;s manual</source>
        <translation>Handbuch von Markermend</translation>
    </message>
    <message>
        <source>Page of the manual</source>
        <translation>Seite des Handbuchs</translation>
    </message>
    <message>
        <source>Contents</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Find in the manual</source>
        <translation>Im Handbuch suchen</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
</context>
<context>
    <name>MarkerModel</name>
    <message>
        <source>Marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Artifacts that are not decided yet, by class</source>
        <translation>Noch nicht entschiedene Artefakte nach Art</translation>
    </message>
    <message>
        <source>Share of the frames in which the marker is missing</source>
        <translation>Anteil der Frames, in denen der Marker fehlt</translation>
    </message>
    <message>
        <source>Open: {0}</source>
        <translation>Offen: {0}</translation>
    </message>
    <message>
        <source>Missing in {0:.2f} % of the frames</source>
        <translation>Fehlt in {0:.2f} % der Frames</translation>
    </message>
</context>
<context>
    <name>MarkerTree</name>
    <message>
        <source>Filter markers</source>
        <translation>Marker filtern</translation>
    </message>
    <message>
        <source>Worst first: a flat list, the markers with most open artifacts on top</source>
        <translation>Schlimmste zuerst: eine flache Liste, oben die Marker mit den meisten offenen Artefakten</translation>
    </message>
    <message>
        <source>Worst first</source>
        <translation>Schlimmste zuerst</translation>
    </message>
    <message>
        <source>Nothing here is named so.</source>
        <translation>Nichts hier heißt so.</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Joints</source>
        <translation>Gelenke</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Worst first: a flat list, the joints with most open artifacts on top</source>
        <translation>Schlimmste zuerst: eine flache Liste, oben die Gelenke mit den meisten offenen Artefakten</translation>
    </message>
    <message>
        <source>Share of the frames in which the joint is missing</source>
        <translation>Anteil der Frames, in denen das Gelenk fehlt</translation>
    </message>
    <message>
        <source>Filter joints</source>
        <translation>Gelenke filtern</translation>
    </message>
    <message>
        <source>Open a take to see its markers here.</source>
        <translation>Eine Aufnahme öffnen, um hier ihre Marker zu sehen.</translation>
    </message>
</context>
<context>
    <name>MethodList</name>
    <message>
        <source>More methods…</source>
        <translation>Weitere Verfahren…</translation>
    </message>
    <message>
        <source>More methods</source>
        <translation>Weitere Verfahren</translation>
    </message>
    <message>
        <source>Repair methods without a key of their own</source>
        <translation>Reparaturverfahren ohne eigene Taste</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>The method that is expected to err least here</source>
        <translation>Das Verfahren, das hier am wenigsten fehlgehen dürfte</translation>
    </message>
    <message>
        <source>Best for this artifact</source>
        <translation>Bestes für dieses Artefakt</translation>
    </message>
    <message>
        <source>{0} (key {1})</source>
        <translation>{0} (Taste {1})</translation>
    </message>
    <message>
        <source>Best: {0}</source>
        <translation>Am besten: {0}</translation>
    </message>
    <message>
        <source>Working out the repair… {0}</source>
        <translation>Die Reparatur wird berechnet… {0}</translation>
    </message>
    <message>
        <source>Repaired. Reopen it to try another method.</source>
        <translation>Repariert. Wieder öffnen, um ein anderes Verfahren zu versuchen.</translation>
    </message>
    <message>
        <source>Working out the repair…</source>
        <translation>Die Reparatur wird berechnet…</translation>
    </message>
    <message>
        <source>No repair: {0}</source>
        <translation>Keine Reparatur: {0}</translation>
    </message>
    <message>
        <source>no answer here</source>
        <translation>hier keine Antwort</translation>
    </message>
    <message>
        <source>{0} accepts the flag, leaves the samples and goes on.</source>
        <translation>{0} nimmt den Befund an, lässt die Werte und geht weiter.</translation>
    </message>
    <message>
        <source>, expected error up to {0} ({1})</source>
        <translation>, erwarteter Fehler bis {0} ({1})</translation>
    </message>
    <message>
        <source>, expected error {0}</source>
        <translation>, erwarteter Fehler {0}</translation>
    </message>
    <message>
        <source>, expected error not measured</source>
        <translation>, erwarteter Fehler nicht gemessen</translation>
    </message>
    <message>
        <source>, following {0}</source>
        <translation>, folgt {0}</translation>
    </message>
</context>
<context>
    <name>ModeButton</name>
    <message>
        <source>Damage</source>
        <translation>Schäden</translation>
    </message>
    <message>
        <source>Gaps</source>
        <translation>Lücken</translation>
    </message>
    <message>
        <source>Off body</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>What the overview shows</source>
        <translation>Was die Übersicht zeigt</translation>
    </message>
    <message>
        <source>Overview: {0}</source>
        <translation>Übersicht: {0}</translation>
    </message>
</context>
<context>
    <name>NoteLine</name>
    <message>
        <source>Nothing written yet</source>
        <translation>Noch nichts geschrieben</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Kept with the review; shown in the queue and in reports</source>
        <translation>Bleibt bei der Durchsicht; steht in Prüfliste und Berichten</translation>
    </message>
</context>
<context>
    <name>Notice</name>
    <message>
        <source>Leave them</source>
        <translation>So lassen</translation>
    </message>
    <message>
        <source>You rejected {0} of {1} decided as {2} on {3}. Make the other {4} less sure, so that they come last?</source>
        <translation>Sie haben {0} von {1} entschiedenen ({2} an {3}) abgelehnt. Die übrigen {4} als unsicherer einstufen, damit sie zuletzt kommen?</translation>
    </message>
    <message>
        <source>You rejected {0} of {1} decided as {2} on {3}. Make the other one less sure, so that it comes last?</source>
        <translation>Sie haben {0} von {1} entschiedenen ({2} an {3}) abgelehnt. Das übrige als unsicherer einstufen, damit es zuletzt kommt?</translation>
    </message>
    <message>
        <source>Lower them</source>
        <translation>Zurückstufen</translation>
    </message>
    <message>
        <source>Lower it</source>
        <translation>Zurückstufen</translation>
    </message>
    <message>
        <source>Leave it</source>
        <translation>So lassen</translation>
    </message>
</context>
<context>
    <name>Overview</name>
    <message>
        <source>Overview of the whole take</source>
        <translation>Übersicht der ganzen Aufnahme</translation>
    </message>
    <message>
        <source>Frame {frame} · {time:.2f} s</source>
        <translation>Frame {frame} · {time:.2f} s</translation>
    </message>
    <message>
        <source>{0} off its body</source>
        <translation>{0} neben seinem Körper</translation>
    </message>
    <message>
        <source>The whole take appears here once one is open.</source>
        <translation>Hier erscheint die ganze Aufnahme, sobald eine offen ist.</translation>
    </message>
    <message>
        <source>There are no markers to be seen here.</source>
        <translation>Hier gibt es keine Marker zu sehen.</translation>
    </message>
    <message>
        <source>Working out residuals… {0:.0%}</source>
        <translation>Residuen werden berechnet… {0:.0%}</translation>
    </message>
</context>
<context>
    <name>Palette</name>
    <message>
        <source>Type a few letters</source>
        <translation>Ein paar Buchstaben tippen</translation>
    </message>
    <message>
        <source>Find a command, marker or artifact</source>
        <translation>Befehl, Marker oder Artefakt finden</translation>
    </message>
    <message>
        <source>Find a command, joint or artifact</source>
        <translation>Befehl, Gelenk oder Artefakt finden</translation>
    </message>
    <message>
        <source>Nothing fits these letters.</source>
        <translation>Nichts passt zu diesen Buchstaben.</translation>
    </message>
    <message>
        <source>Found</source>
        <translation>Gefunden</translation>
    </message>
</context>
<context>
    <name>PlotHeader</name>
    <message>
        <source>Readout</source>
        <translation>Anzeige</translation>
    </message>
    <message>
        <source>Plots</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>Choose what the plots show</source>
        <translation>Wählen, was die Kurven zeigen</translation>
    </message>
    <message>
        <source>Back to the artifact under review</source>
        <translation>Zurück zum Artefakt in Durchsicht</translation>
    </message>
    <message>
        <source>Back to {0}</source>
        <translation>Zurück zu {0}</translation>
    </message>
    <message>
        <source>Under review, but out of sight: {0} on {1}</source>
        <translation>In Durchsicht, aber nicht zu sehen: {0} an {1}</translation>
    </message>
</context>
<context>
    <name>Preferences</name>
    <message>
        <source>Preferences</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Restore defaults</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aussehen</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>High contrast</source>
        <translation>Hoher Kontrast</translation>
    </message>
    <message>
        <source>Colours for colour-blind eyes</source>
        <translation>Farben für farbenblinde Augen</translation>
    </message>
    <message>
        <source>Choose the colour of {0}</source>
        <translation>Farbe wählen für: {0}</translation>
    </message>
    <message>
        <source>Classes</source>
        <translation>Arten</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Holds from the next start on.</source>
        <translation>Gilt ab dem nächsten Start.</translation>
    </message>
    <message>
        <source>Numbers and space</source>
        <translation>Zahlen und Raum</translation>
    </message>
    <message>
        <source>Lengths in</source>
        <translation>Längen in</translation>
    </message>
    <message>
        <source>millimetres</source>
        <translation>Millimetern</translation>
    </message>
    <message>
        <source>centimetres</source>
        <translation>Zentimetern</translation>
    </message>
    <message>
        <source>metres</source>
        <translation>Metern</translation>
    </message>
    <message>
        <source>What the window shows; files keep their own unit.</source>
        <translation>Was das Fenster zeigt; Dateien behalten ihre eigene Einheit.</translation>
    </message>
    <message>
        <source>Axis that points up</source>
        <translation>Achse nach oben</translation>
    </message>
    <message>
        <source>As the take suggests</source>
        <translation>Wie die Aufnahme nahelegt</translation>
    </message>
    <message>
        <source>Detection</source>
        <translation>Erkennung</translation>
    </message>
    <message>
        <source>Detect after opening a take</source>
        <translation>Nach dem Öffnen einer Aufnahme suchen</translation>
    </message>
    <message>
        <source>How</source>
        <translation>Wie</translation>
    </message>
    <message>
        <source>Sensitivity</source>
        <translation>Empfindlichkeit</translation>
    </message>
    <message>
        <source>Higher finds more, and more false alarms, from the next search on.</source>
        <translation>Höher findet ab der nächsten Suche mehr und schlägt öfter falschen Alarm.</translation>
    </message>
    <message>
        <source>Skeleton recordings</source>
        <translation>Skelettaufnahmen</translation>
    </message>
    <message>
        <source>How bodies move</source>
        <translation>Wie sich Körper bewegen</translation>
    </message>
    <message>
        <source>Work</source>
        <translation>Arbeit</translation>
    </message>
    <message>
        <source>only when a take is closed</source>
        <translation>nur beim Schließen einer Aufnahme</translation>
    </message>
    <message>
        <source>every </source>
        <translation>alle </translation>
    </message>
    <message>
        <source> min</source>
        <translation> min</translation>
    </message>
    <message>
        <source>Save the review</source>
        <translation>Durchsicht speichern</translation>
    </message>
    <message>
        <source>Each step is kept at once in any case, also through a crash.</source>
        <translation>Jeder Schritt ist ohnehin sofort gesichert, auch über einen Absturz hinweg.</translation>
    </message>
    <message>
        <source>as many as there are cores</source>
        <translation>so viele, wie es Kerne gibt</translation>
    </message>
    <message>
        <source>Processes</source>
        <translation>Prozesse</translation>
    </message>
    <message>
        <source>Used to look for slow drifts in long takes.</source>
        <translation>Für die Suche nach langsamer Drift in langen Aufnahmen.</translation>
    </message>
    <message>
        <source>Keys as in</source>
        <translation>Tasten wie in</translation>
    </message>
    <message>
        <source>All keys on one sheet, each to be changed, with presets.</source>
        <translation>Alle Tasten auf einem Blatt, jede änderbar, mit Vorlagen.</translation>
    </message>
    <message>
        <source>Not for the open recording: its joints are looked at in one way.
Close it to set this for the next take.</source>
        <translation>Nicht für die geöffnete Aufnahme: Ihre Gelenke werden immer auf dieselbe Art untersucht.
Schließen Sie sie, um dies für die nächste Aufnahme festzulegen.</translation>
    </message>
    <message>
        <source>Preset “{0}”</source>
        <translation>Vorgabe „{0}“</translation>
    </message>
    <message>
        <source>Preset “{0}”, which is gone</source>
        <translation>Vorgabe „{0}“, die es nicht mehr gibt</translation>
    </message>
    <message>
        <source>As dialled</source>
        <translation>Wie eingestellt</translation>
    </message>
    <message>
        <source>Colour of {0}</source>
        <translation>Farbe von: {0}</translation>
    </message>
    <message>
        <source>Keys as in {0}</source>
        <translation>Tasten wie in {0}</translation>
    </message>
</context>
<context>
    <name>PriorChoice</name>
    <message>
        <source>How bodies move</source>
        <translation>Wie sich Körper bewegen</translation>
    </message>
    <message>
        <source>From a file…</source>
        <translation>Aus einer Datei …</translation>
    </message>
    <message>
        <source>Learn…</source>
        <translation>Lernen …</translation>
    </message>
    <message>
        <source>Learn from clean recordings</source>
        <translation>Aus sauberen Aufnahmen lernen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>As Markermend knows it</source>
        <translation>Wie Markermend es kennt</translation>
    </message>
    <message>
        <source>As {0} tells</source>
        <translation>Wie {0} es lehrt</translation>
    </message>
    <message>
        <source>As {0} told, which is gone</source>
        <translation>Wie {0} es lehrte (fehlt jetzt)</translation>
    </message>
    <message>
        <source>Clean recordings of a performer tell most of how that one moves in gaps. Up to ten minutes of them are kept in the file.</source>
        <translation>Saubere Aufnahmen einer Person lehren am meisten, wie sie sich in Lücken bewegt. Bis zu zehn Minuten davon stehen in der Datei.</translation>
    </message>
    <message>
        <source>Used for skeletons with the joints it was learnt from, opened from now on; for others, what Markermend knows.</source>
        <translation>Gilt für Skelette mit den gelernten Gelenken, die ab jetzt geöffnet werden; für andere gilt, was Markermend kennt.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Lesen</translation>
    </message>
    <message>
        <source>Clean recordings to learn from</source>
        <translation>Saubere Aufnahmen, aus denen gelernt wird</translation>
    </message>
    <message>
        <source>Learning</source>
        <translation>Lernen</translation>
    </message>
    <message>
        <source>Keep how they move in</source>
        <translation>Gelerntes speichern in</translation>
    </message>
    <message>
        <source>Priors</source>
        <translation>Gelernte Bewegung</translation>
    </message>
</context>
<context>
    <name>QualityPanel</name>
    <message>
        <source>Quality, marker by marker</source>
        <translation>Qualität, Marker für Marker</translation>
    </message>
    <message>
        <source>Quality of the whole take</source>
        <translation>Qualität der ganzen Aufnahme</translation>
    </message>
    <message>
        <source>How an open take stands appears here.</source>
        <translation>Hier erscheint, wie es um eine offene Aufnahme steht.</translation>
    </message>
    <message>
        <source>Quality, joint by joint</source>
        <translation>Qualität, Gelenk für Gelenk</translation>
    </message>
    <message>
        <source>Region</source>
        <translation>Ausschnitt</translation>
    </message>
</context>
<context>
    <name>QueueFilters</name>
    <message>
        <source>Which decisions are listed</source>
        <translation>Welche Entscheidungen aufgeführt sind</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Accepted, not repaired</source>
        <translation>Angenommen, nicht repariert</translation>
    </message>
    <message>
        <source>Decided</source>
        <translation>Entschieden</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Only: {0}</source>
        <translation>Nur: {0}</translation>
    </message>
    <message>
        <source>Filter by marker</source>
        <translation>Nach Marker filtern</translation>
    </message>
    <message>
        <source>Filter by joint</source>
        <translation>Nach Gelenk filtern</translation>
    </message>
    <message>
        <source>{0} of {1} decided</source>
        <translation>{0} von {1} entschieden</translation>
    </message>
    <message>
        <source>{0} open</source>
        <translation>{0} offen</translation>
    </message>
    <message>
        <source>{0} rows chosen</source>
        <translation>{0} Zeilen gewählt</translation>
    </message>
</context>
<context>
    <name>QueueModel</name>
    <message>
        <source>Status</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Marker</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Axes</source>
        <translation>Achsen</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Frames</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Sicherheit</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Warum</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Accepted</source>
        <translation>Angenommen</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Abgelehnt</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Repariert</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Open ones first, the worst on top: size times confidence</source>
        <translation>Offene zuerst, das Schlimmste oben: Größe mal Sicherheit</translation>
    </message>
    <message>
        <source>With it: {0}</source>
        <translation>Mit ihm: {0}</translation>
    </message>
    <message>
        <source>Whole body</source>
        <translation>Ganzer Körper</translation>
    </message>
</context>
<context>
    <name>References</name>
    <message>
        <source>Choose the markers that {0} is to follow: by clicks in the 3D view, or by Return in the tree.</source>
        <translation>Die Marker wählen, denen {0} folgen soll: durch Klicks in der 3D-Ansicht oder die Eingabetaste im Baum.</translation>
    </message>
    <message>
        <source>Choose the joints that {0} is to follow: by clicks in the 3D view, or by Return in the tree.</source>
        <translation>Die Gelenke wählen, denen {0} folgen soll: durch Klicks in der 3D-Ansicht oder die Eingabetaste im Baum.</translation>
    </message>
</context>
<context>
    <name>RegionOfInterest</name>
    <message>
        <source>The whole take is reviewed.</source>
        <translation>Die ganze Aufnahme wird durchgesehen.</translation>
    </message>
    <message>
        <source>Frames {0}–{1} are reviewed.</source>
        <translation>Frames {0}–{1} werden durchgesehen.</translation>
    </message>
    <message>
        <source>Artifacts outside them: {0}.</source>
        <translation>Artefakte außerhalb: {0}.</translation>
    </message>
</context>
<context>
    <name>Repairing</name>
    <message>
        <source>There is nothing to repair: no artifact is accepted.</source>
        <translation>Es gibt nichts zu reparieren: Kein Artefakt ist angenommen.</translation>
    </message>
    <message>
        <source>The review changed meanwhile; repair again.</source>
        <translation>Die Durchsicht hat sich inzwischen geändert; bitte erneut reparieren.</translation>
    </message>
    <message>
        <source>{0} repaired.</source>
        <translation>{0} repariert.</translation>
    </message>
    <message>
        <source>1 left as it is: {1}</source>
        <translation>1 bleibt, wie es ist: {1}</translation>
    </message>
    <message>
        <source>{0} left as they are: {1}</source>
        <translation>{0} bleiben, wie sie sind: {1}</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>Reparatur</translation>
    </message>
</context>
<context>
    <name>Reporting</name>
    <message>
        <source>Report on this review</source>
        <translation>Bericht über diese Durchsicht</translation>
    </message>
    <message>
        <source>HTML (*.html)</source>
        <translation>HTML (*.html)</translation>
    </message>
    <message>
        <source>Report written to {0}.</source>
        <translation>Bericht nach {0} geschrieben.</translation>
    </message>
    <message>
        <source>Reporting</source>
        <translation>Bericht wird geschrieben</translation>
    </message>
</context>
<context>
    <name>ReviewQueue</name>
    <message>
        <source>Review queue</source>
        <translation>Prüfliste</translation>
    </message>
    <message>
        <source>Repair, each by its best method</source>
        <translation>Reparieren, jedes mit seinem besten Verfahren</translation>
    </message>
    <message>
        <source>The only artifact is decided, and the repaired take is exported.</source>
        <translation>Das einzige Artefakt ist entschieden und die reparierte Aufnahme exportiert.</translation>
    </message>
    <message>
        <source>All {0} artifacts are decided, and the repaired take is exported.</source>
        <translation>Alle {0} Artefakte sind entschieden und die reparierte Aufnahme ist exportiert.</translation>
    </message>
    <message>
        <source>{0} is accepted but not repaired; {1} repairs what is accepted.</source>
        <translation>{0} ist angenommen, aber nicht repariert; {1} repariert, was angenommen ist.</translation>
    </message>
    <message>
        <source>{0} are accepted but not repaired; {1} repairs what is accepted.</source>
        <translation>{0} sind angenommen, aber nicht repariert; {1} repariert, was angenommen ist.</translation>
    </message>
    <message>
        <source>Open a take to review its artifacts here.</source>
        <translation>Eine Aufnahme öffnen, um hier ihre Artefakte durchzusehen.</translation>
    </message>
    <message>
        <source>This file has no markers, so there is nothing to review.</source>
        <translation>Diese Datei hat keine Marker, also gibt es nichts durchzusehen.</translation>
    </message>
    <message>
        <source>Nothing was found. Sweep over a curve with Shift to mark by hand.</source>
        <translation>Nichts gefunden. Mit Umschalt über eine Kurve streichen, um von Hand zu kennzeichnen.</translation>
    </message>
    <message>
        <source>Nothing found yet. {0} looks for artifacts.</source>
        <translation>Noch nichts gefunden. {0} sucht nach Artefakten.</translation>
    </message>
    <message>
        <source>Nothing has been found in it yet.</source>
        <translation>Noch wurde nichts darin gefunden.</translation>
    </message>
    <message>
        <source>Every artifact lies outside the region of interest.</source>
        <translation>Alle Artefakte liegen außerhalb des Ausschnitts.</translation>
    </message>
    <message>
        <source>{0} reviews the whole take.</source>
        <translation>{0} sieht die ganze Aufnahme durch.</translation>
    </message>
    <message>
        <source>The only artifact is decided. {0} exports the repaired take.</source>
        <translation>Das einzige Artefakt ist entschieden. {0} exportiert die reparierte Aufnahme.</translation>
    </message>
    <message>
        <source>All {0} artifacts are decided. {1} exports the repaired take.</source>
        <translation>Alle {0} Artefakte sind entschieden. {1} exportiert die reparierte Aufnahme.</translation>
    </message>
    <message>
        <source>Outside the region of interest: {0}.</source>
        <translation>Außerhalb des Ausschnitts: {0}.</translation>
    </message>
    <message>
        <source>No artifact matches these filters.</source>
        <translation>Kein Artefakt passt zu diesen Filtern.</translation>
    </message>
</context>
<context>
    <name>Scene</name>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>Open a take to see it in space.</source>
        <translation>Eine Aufnahme öffnen, um sie im Raum zu sehen.</translation>
    </message>
    <message>
        <source>No frames</source>
        <translation>Keine Frames</translation>
    </message>
    <message>
        <source>One square: {0}</source>
        <translation>Ein Quadrat: {0}</translation>
    </message>
    <message>
        <source>Click the markers to follow</source>
        <translation>Die Marker anklicken, denen gefolgt wird</translation>
    </message>
    <message>
        <source>Click the joints to follow</source>
        <translation>Die Gelenke anklicken, denen gefolgt wird</translation>
    </message>
    <message>
        <source>Before repair</source>
        <translation>Vor der Reparatur</translation>
    </message>
</context>
<context>
    <name>SceneButtons</name>
    <message>
        <source>Show everything (double click)</source>
        <translation>Alles zeigen (Doppelklick)</translation>
    </message>
    <message>
        <source>Keep the body in the middle</source>
        <translation>Den Körper in der Mitte halten</translation>
    </message>
    <message>
        <source>Trails of all markers</source>
        <translation>Spuren aller Marker</translation>
    </message>
    <message>
        <source>Trails of all joints</source>
        <translation>Spuren aller Gelenke</translation>
    </message>
    <message>
        <source>Names of all markers</source>
        <translation>Namen aller Marker</translation>
    </message>
    <message>
        <source>Names of all joints</source>
        <translation>Namen aller Gelenke</translation>
    </message>
    <message>
        <source>Select joints with a box (Esc ends it)</source>
        <translation>Gelenke mit einem Rahmen auswählen (Esc beendet)</translation>
    </message>
    <message>
        <source>Select markers with a box (Esc ends it)</source>
        <translation>Marker mit einem Rahmen auswählen (Esc beendet)</translation>
    </message>
    <message>
        <source>Select joints with a lasso (Esc ends)</source>
        <translation>Gelenke mit einem Lasso auswählen (Esc beendet)</translation>
    </message>
    <message>
        <source>Select markers with a lasso (Esc ends)</source>
        <translation>Marker mit einem Lasso auswählen (Esc beendet)</translation>
    </message>
    <message>
        <source>Colours, ghost, segments, vertical axis</source>
        <translation>Farben, Geist, Segmente, senkrechte Achse</translation>
    </message>
</context>
<context>
    <name>SelectionPage</name>
    <message>
        <source>Mark the swept frames as: {0}</source>
        <translation>Die überstrichenen Frames kennzeichnen als: {0}</translation>
    </message>
    <message>
        <source>Repair</source>
        <translation>Reparieren</translation>
    </message>
    <message>
        <source>Smooth…</source>
        <translation>Glätten…</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Ausschneiden</translation>
    </message>
    <message>
        <source>Swap…</source>
        <translation>Tauschen…</translation>
    </message>
    <message>
        <source>Give away…</source>
        <translation>Weggeben…</translation>
    </message>
    <message>
        <source>Review only this</source>
        <translation>Nur dies durchsehen</translation>
    </message>
    <message>
        <source>Mark the selection as</source>
        <translation>Auswahl kennzeichnen als</translation>
    </message>
    <message>
        <source>Do something to it</source>
        <translation>Etwas damit tun</translation>
    </message>
    <message>
        <source>Selection on {0}</source>
        <translation>Auswahl an {0}</translation>
    </message>
    <message>
        <source>Frame {0}, {1:.2f} s</source>
        <translation>Frame {0}, {1:.2f} s</translation>
    </message>
    <message>
        <source>Frames {0} to {1}: {2} frames, {3:.2f} s</source>
        <translation>Frames {0} bis {1}: {2} Frames, {3:.2f} s</translation>
    </message>
</context>
<context>
    <name>ShortcutSheet</name>
    <message>
        <source>Keyboard and mouse</source>
        <translation>Tastatur und Maus</translation>
    </message>
    <message>
        <source>Find by name or key</source>
        <translation>Nach Name oder Taste suchen</translation>
    </message>
    <message>
        <source>Keys as in</source>
        <translation>Tasten wie in</translation>
    </message>
    <message>
        <source>Actions and keys</source>
        <translation>Aktionen und Tasten</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>No action or key is named so.</source>
        <translation>Keine Aktion oder Taste heißt so.</translation>
    </message>
    <message>
        <source>New key</source>
        <translation>Neue Taste</translation>
    </message>
    <message>
        <source>Use this key</source>
        <translation>Diese Taste verwenden</translation>
    </message>
    <message>
        <source>No key</source>
        <translation>Keine Taste</translation>
    </message>
    <message>
        <source>As in the preset</source>
        <translation>Wie in der Vorgabe</translation>
    </message>
    <message>
        <source>Take this key</source>
        <translation>Diese Taste wegnehmen</translation>
    </message>
    <message>
        <source>{0} belongs to “{1}”, which would lose it.</source>
        <translation>{0} gehört „{1}“, das sie verlöre.</translation>
    </message>
    <message>
        <source>Take all keys of {0}?</source>
        <translation>Alle Tasten von {0} übernehmen?</translation>
    </message>
    <message>
        <source>What you changed by hand would be lost.</source>
        <translation>Was Sie von Hand geändert haben, ginge verloren.</translation>
    </message>
</context>
<context>
    <name>Sight</name>
    <message>
        <source>{0} on {1} is under review, but was out of sight. Press again to decide.</source>
        <translation>{0} an {1} ist in Durchsicht, war aber nicht zu sehen. Zum Entscheiden noch einmal drücken.</translation>
    </message>
</context>
<context>
    <name>SmoothDialog</name>
    <message>
        <source>Smooth</source>
        <translation>Glätten</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Ort</translation>
    </message>
    <message>
        <source>Velocity</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Acceleration</source>
        <translation>Beschleunigung</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>Before smoothing</source>
        <translation>Vor dem Glätten</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Methode</translation>
    </message>
    <message>
        <source>Marker looked at</source>
        <translation>Betrachteter Marker</translation>
    </message>
    <message>
        <source>Joint looked at</source>
        <translation>Betrachtetes Gelenk</translation>
    </message>
    <message>
        <source>Axis looked at</source>
        <translation>Betrachtete Achse</translation>
    </message>
    <message>
        <source>Quantity looked at</source>
        <translation>Betrachtete Größe</translation>
    </message>
    <message>
        <source>1 artifact there is not repaired. Smoothing spreads damage: repair first.</source>
        <translation>1 Artefakt dort ist nicht repariert. Glätten verschmiert Schäden: zuerst reparieren.</translation>
    </message>
    <message>
        <source>{0} artifacts there are not repaired. Smoothing spreads damage: repair first.</source>
        <translation>{0} Artefakte dort sind nicht repariert. Glätten verschmiert Schäden: zuerst reparieren.</translation>
    </message>
    <message>
        <source>%SM1: how much shorter the way of the marker becomes on each axis. Noise makes it longer; above {0:g} % some of the movement may go, too.</source>
        <translation>%SM1: um wie viel kürzer der Weg des Markers auf jeder Achse wird. Rauschen macht ihn länger; über {0:g} % geht vielleicht auch Bewegung verloren.</translation>
    </message>
    <message>
        <source>%SM1 of {0}:  {1}</source>
        <translation>%SM1 von {0}:  {1}</translation>
    </message>
    <message>
        <source>Nothing changes: the stretches seen are too short.</source>
        <translation>Nichts ändert sich: die sichtbaren Abschnitte sind zu kurz.</translation>
    </message>
    <message>
        <source>{0} of {1} markers lose more than {2:g} % of their way, {3} most ({4} {5:.0f}). Look whether movement went with the noise.</source>
        <translation>{0} von {1} Markern verlieren mehr als {2:g} % ihres Wegs, am meisten {3} ({4} {5:.0f}). Prüfen Sie, ob mit dem Rauschen Bewegung verschwand.</translation>
    </message>
    <message>
        <source>{0} of {1} joints lose more than {2:g} % of their way, {3} most ({4} {5:.0f}). Look whether movement went with the noise.</source>
        <translation>{0} von {1} Gelenken verlieren mehr als {2:g} % ihres Wegs, am meisten {3} ({4} {5:.0f}). Prüfen Sie, ob mit dem Rauschen Bewegung verschwand.</translation>
    </message>
    <message>
        <source>{3} loses more than {2:g} % of its way ({4} {5:.0f}). Look whether movement went with the noise.</source>
        <translation>{3} verliert mehr als {2:g} % seines Wegs ({4} {5:.0f}). Prüfen Sie, ob mit dem Rauschen Bewegung verschwand.</translation>
    </message>
</context>
<context>
    <name>SmoothPictures</name>
    <message>
        <source>Curve, spectrum and residuals before and after</source>
        <translation>Kurve, Spektrum und Residuen vorher und nachher</translation>
    </message>
    <message>
        <source>Spectrum</source>
        <translation>Spektrum</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>Residuen</translation>
    </message>
    <message>
        <source>Hz</source>
        <translation>Hz</translation>
    </message>
    <message>
        <source>Residuals: too few frames without a gap</source>
        <translation>Residuen: zu wenige Frames ohne Lücke</translation>
    </message>
    <message>
        <source>mm²/Hz</source>
        <translation>mm²/Hz</translation>
    </message>
    <message>
        <source>Residuals: cut at {0:.1f} Hz, noise {1}</source>
        <translation>Residuen: Grenze bei {0:.1f} Hz, Rauschen {1}</translation>
    </message>
</context>
<context>
    <name>Smoothing</name>
    <message>
        <source>Frames {0}–{1} of {2}</source>
        <translation>Frames {0}–{1} von {2}</translation>
    </message>
    <message>
        <source>Smoothing</source>
        <translation>Glätten</translation>
    </message>
    <message>
        <source>The review changed meanwhile; do it again.</source>
        <translation>Die Durchsicht hat sich inzwischen geändert; bitte noch einmal.</translation>
    </message>
    <message>
        <source>{0}.</source>
        <translation>{0}.</translation>
    </message>
</context>
<context>
    <name>StatusLine</name>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Artifacts decided, time for each, and time spent on the take without pauses</source>
        <translation>Entschiedene Artefakte, Zeit für jedes und Zeit für die Aufnahme ohne Pausen</translation>
    </message>
    <message>
        <source>Stopping…</source>
        <translation>Wird angehalten…</translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation>Abgebrochen.</translation>
    </message>
    <message>
        <source>{0} of {1} decided</source>
        <translation>{0} von {1} entschieden</translation>
    </message>
    <message>
        <source> · {0:.1f} s each</source>
        <translation> · je {0:.1f} s</translation>
    </message>
    <message>
        <source> · {0:.1f} s in all</source>
        <translation> · {0:.1f} s insgesamt</translation>
    </message>
    <message>
        <source> · {0:.1f} min in all</source>
        <translation> · insgesamt {0:.1f} min</translation>
    </message>
</context>
<context>
    <name>TakeList</name>
    <message>
        <source>Takes</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>{0} of {1} takes done</source>
        <translation>{0} von {1} Aufnahmen fertig</translation>
    </message>
    <message>
        <source>Next take</source>
        <translation>Nächste Aufnahme</translation>
    </message>
</context>
<context>
    <name>TakePage</name>
    <message>
        <source>Take</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Frames</translation>
    </message>
    <message>
        <source>Rate</source>
        <translation>Rate</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Dauer</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marker</translation>
    </message>
    <message>
        <source>Joints</source>
        <translation>Gelenke</translation>
    </message>
    <message>
        <source>Unlabelled</source>
        <translation>Unbenannt</translation>
    </message>
    <message>
        <source>Subjects</source>
        <translation>Personen</translation>
    </message>
    <message>
        <source>Other points</source>
        <translation>Andere Punkte</translation>
    </message>
    <message>
        <source>Analog</source>
        <translation>Analog</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>Fehlend</translation>
    </message>
    <message>
        <source>Reviewed</source>
        <translation>Durchgesehen</translation>
    </message>
    <message>
        <source>Frames {0} to {1}</source>
        <translation>Frames {0} bis {1}</translation>
    </message>
    <message>
        <source>{0:.2f} % of all samples</source>
        <translation>{0:.2f} % aller Werte</translation>
    </message>
    <message>
        <source>{0:.2f} % of the samples reviewed</source>
        <translation>{0:.2f} % der durchgesehenen Werte</translation>
    </message>
</context>
<context>
    <name>Tour</name>
    <message>
        <source>{0} opens the manual at the panel in use, {1} lists every key, and {2} finds any command by a few letters. The tour is in the Help menu.</source>
        <translation>{0} öffnet das Handbuch zum benutzten Bereich, {1} zeigt alle Tasten, und {2} findet jeden Befehl mit ein paar Buchstaben. Der Rundgang steht im Menü Hilfe.</translation>
    </message>
    <message>
        <source>That is the whole round</source>
        <translation>Das war der Rundgang</translation>
    </message>
    <message>
        <source>{0} of {1}</source>
        <translation>{0} von {1}</translation>
    </message>
</context>
<context>
    <name>TourCard</name>
    <message>
        <source>Skip this step</source>
        <translation>Überspringen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>End the tour</source>
        <translation>Rundgang beenden</translation>
    </message>
</context>
<context>
    <name>TrajectoryPanel</name>
    <message>
        <source>Trajectories</source>
        <translation>Trajektorien</translation>
    </message>
    <message>
        <source>Plots of the shown markers</source>
        <translation>Kurven der gezeigten Marker</translation>
    </message>
    <message>
        <source>Plots of the shown joints</source>
        <translation>Kurven der gezeigten Gelenke</translation>
    </message>
    <message>
        <source>To {0}</source>
        <translation>Zu {0}</translation>
    </message>
</context>
<context>
    <name>Transport</name>
    <message>
        <source>Frame</source>
        <translation>Frame</translation>
    </message>
    <message>
        <source>Frame number</source>
        <translation>Framenummer</translation>
    </message>
    <message>
        <source>Frame number, as in the file</source>
        <translation>Framenummer wie in der Datei</translation>
    </message>
    <message>
        <source>Time since the first frame, and length of the take</source>
        <translation>Zeit seit dem ersten Frame und Länge der Aufnahme</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>Speed of playback</source>
        <translation>Tempo der Wiedergabe</translation>
    </message>
    <message>
        <source>To the first frame</source>
        <translation>Zum ersten Frame</translation>
    </message>
    <message>
        <source>One frame back</source>
        <translation>Einen Frame zurück</translation>
    </message>
    <message>
        <source>One frame forward</source>
        <translation>Einen Frame vor</translation>
    </message>
    <message>
        <source>To the last frame</source>
        <translation>Zum letzten Frame</translation>
    </message>
    <message>
        <source>Repeat what the plots show</source>
        <translation>Wiederholen, was die Kurven zeigen</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
</context>
<context>
    <name>Welcome</name>
    <message>
        <source>Open a take to mend</source>
        <translation>Eine Aufnahme zum Reparieren öffnen</translation>
    </message>
    <message>
        <source>Drop a C3D, TRC, CSV, AMC or BVH file here, or begin with the demo take.</source>
        <translation>Eine C3D-, TRC-, CSV-, AMC- oder BVH-Datei hierher ziehen oder mit der Beispielaufnahme beginnen.</translation>
    </message>
    <message>
        <source>Open take…</source>
        <translation>Aufnahme öffnen…</translation>
    </message>
    <message>
        <source>Open a take</source>
        <translation>Eine Aufnahme öffnen</translation>
    </message>
    <message>
        <source>Open the demo take</source>
        <translation>Beispielaufnahme öffnen</translation>
    </message>
</context>
<context>
    <name>_Steps</name>
    <message>
        <source>As opened</source>
        <translation>Wie geöffnet</translation>
    </message>
</context>
</TS>
