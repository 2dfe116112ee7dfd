"""The dictionaries of a case: numbers and names from our own lists, nothing from a scene as text."""

from pathlib import Path
from foamlib import DimensionSet, FoamFile

ITERATIONS = 5000
RELAX_U = 0.95
ADVECTION={"second": ("bounded","Gauss","linearUpwind","grad(U)"), "upwind":("bounded","Gauss","upwind")}

def write_dictionaries(directory: Path, nu: float, tol: float, relax=RELAX_U, extra=None) -> None:
    extra = extra or {}
    (directory / "system").mkdir(parents=True, exist_ok=True)
    (directory / "0").mkdir(exist_ok=True)
    def put(name, entries, cls="dictionary"):
        with FoamFile(directory / name) as f:
            f["FoamFile"]={"version":2.0,"format":"ascii","class":cls,"object":Path(name).name}
            for k,v in entries.items(): f[k]=v
    put("system/controlDict", {"application":"simpleFoam","startFrom":"startTime","startTime":0,"stopAt":"endTime","endTime":ITERATIONS,"deltaT":1,"writeControl":"timeStep","writeInterval":ITERATIONS,"purgeWrite":0,"writeFormat":"binary","writePrecision":12,"writeCompression":False,"timeFormat":"general","runTimeModifiable":False})
    put("system/fvSchemes", {"ddtSchemes":{"default":"steadyState"},"gradSchemes":{"default":extra.get("grad",("Gauss","linear"))},
     "divSchemes":{"default":"none","div(phi,U)":ADVECTION["second"],"div((nuEff*dev2(T(grad(U)))))":("Gauss","linear")},
     "laplacianSchemes":{"default":("Gauss","linear","corrected")},"interpolationSchemes":{"default":"linear"},"snGradSchemes":{"default":"corrected"}})
    put("system/fvSolution", {"solvers":{
      "p":{"solver":"GAMG","smoother":"DICGaussSeidel","tolerance":extra.get("ptol",1e-12),"relTol":0.1,"nCellsInCoarsestLevel":20},
      "U":{"solver":"PBiCGStab","preconditioner":"DILU","tolerance":1e-12,"relTol":0.01}},
      "SIMPLE":{"consistent":True,"nNonOrthogonalCorrectors":extra.get("nonorth",0),"pRefCell":0,"pRefValue":0,"residualControl":{"p":tol,"U":tol}},
      "relaxationFactors":{"fields":{"p":extra.get("relp",1.0)},"equations":{"U":relax}}})
    put("constant/transportProperties", {"transportModel":"Newtonian","nu":nu})
    put("constant/turbulenceProperties", {"simulationType":"laminar"})
    put("0/U", {"dimensions":DimensionSet(length=1,time=-1),"internalField":[0.5,0.0,0.0],"boundaryField":{
      "inlet":{"type":"cyclic"},"outlet":{"type":"cyclic"},"lower":{"type":"noSlip"},
      "upper":{"type":"fixedValue","value":[1.0,0.0,0.0]},"back":{"type":"empty"},"front":{"type":"empty"}}},"volVectorField")
    put("0/p", {"dimensions":DimensionSet(length=2,time=-2),"internalField":0.0,"boundaryField":{
      "inlet":{"type":"cyclic"},"outlet":{"type":"cyclic"},"lower":{"type":"zeroGradient"},
      "upper":{"type":"zeroGradient"},"back":{"type":"empty"},"front":{"type":"empty"}}},"volScalarField")
