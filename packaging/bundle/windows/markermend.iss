; Inno Setup: iscc packaging\bundle\windows\markermend.iss, after packaging\bundle\build.py.
#define Version GetVersionNumbersString("..\..\..\build\bundle\Markermend\markermend.exe")
[Setup]
AppId={{6C1E3B53-8D0A-4C38-9B0E-5C3D7E0F7A21}
AppName=Markermend
AppVersion={#Version}
DefaultDirName={autopf}\Markermend
DefaultGroupName=Markermend
PrivilegesRequired=lowest
PrivilegesRequiredOverridesAllowed=dialog
ChangesAssociations=yes
OutputDir=..\..\..\build\bundle
OutputBaseFilename=Markermend-setup
SetupIconFile=..\..\..\build\bundle-icons\markermend.ico
UninstallDisplayIcon={app}\markermend-window.exe
Compression=lzma2

[Files]
Source: "..\..\..\build\bundle\Markermend\*"; DestDir: "{app}"; Flags: recursesubdirs

[Icons]
Name: "{group}\Markermend"; Filename: "{app}\markermend-window.exe"

[Tasks]
Name: associate; Description: "Open .c3d files with Markermend"

[Registry]
Root: HKA; Subkey: "Software\Classes\.c3d\OpenWithProgids"; ValueType: string; ValueName: "Markermend.c3d"; Flags: uninsdeletevalue; Tasks: associate
Root: HKA; Subkey: "Software\Classes\Markermend.c3d"; ValueType: string; ValueData: "C3D motion capture recording"; Flags: uninsdeletekey; Tasks: associate
Root: HKA; Subkey: "Software\Classes\Markermend.c3d\DefaultIcon"; ValueType: string; ValueData: "{app}\markermend-window.exe,0"; Tasks: associate
Root: HKA; Subkey: "Software\Classes\Markermend.c3d\shell\open\command"; ValueType: string; ValueData: """{app}\markermend-window.exe"" ""%1"""; Tasks: associate
