# Pictures of programs and of the explorer.
use rule evidence as user_code_picture with:
    input:
        unpack(lambda wildcards: behind_engine(f"examples/figures/{wildcards.program}.py")(wildcards)),
    output:
        "docs/user_code/{program}.png",
    log:
        "logs/validation/user_code_{program}.log",
    params:
        **evidence("user_code.picture"),


use rule evidence as explorer_picture with:
    input:
        unpack(behind_engine("results/explorer.html")),
    output:
        "docs/explorer.png",
    log:
        "logs/validation/explorer_picture.log",
    params:
        **evidence("explorer_picture.picture"),
